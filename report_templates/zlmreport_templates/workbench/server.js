// Requests to the server of the workbench. Every answer is values; a refusal is an error with sentences for people.

/** What stands before the addresses of a job: nothing, or its place in a folder of jobs. */
export const ROOT = location.pathname.match(/^\/jobs\/[^/]+/)?.[0] ?? "";

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

/** Return what stands at an address, asked with values. */
export async function get(path, values = {}) {
  return answered(path, {}, values);
}

/** Return what is known by a name, or else ask for it; what is not to be had is asked for again the next time. */
export function remembered(known, name, path, values) {
  if (!known.has(name)) {
    const asked = get(path, values);
    known.set(name, asked);
    asked.catch(() => known.delete(name));
  }
  return known.get(name);
}

/** Send a click, with the digest of the job that it was made on. */
export async function post(path, body) {
  return answered(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
}

async function answered(path, options, values = {}) {
  const query = new URLSearchParams(language ? { ...values, lang: language } : values).toString();
  let response;
  try {
    response = await fetch(`${ROOT}${path}${query && `?${query}`}`, options);
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
