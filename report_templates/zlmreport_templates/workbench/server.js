// Asks the server. Every answer is values; a refusal is an error with sentences for people.

const language = new URLSearchParams(location.search).get("lang");

/** Sentences of the server on what it did not do, and its status. */
export class Refusal extends Error {
  constructor(status, answer) {
    super(answer.problems.join("\n"));
    this.status = status;
    this.problems = answer.problems;
    this.stamp = answer.stamp;
  }
}

/** Nobody answers. */
export class Silence extends Error {}

/** Return what stands at an address. */
export async function get(path) {
  return answered(path, {});
}

/** Send a click, with the digest of the job that it was made on. */
export async function post(path, body) {
  return answered(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
}

/** Return an address in the language of the page. */
export function addressed(path) {
  return language ? `${path}?lang=${encodeURIComponent(language)}` : path;
}

async function answered(path, options) {
  let response;
  try {
    response = await fetch(addressed(path), options);
  } catch {
    throw new Silence();
  }
  const text = await response.text();
  let answer;
  try {
    answer = JSON.parse(text);
  } catch {
    answer = { problems: [text] };
  }
  if (!response.ok) throw new Refusal(response.status, answer);
  return answer;
}
