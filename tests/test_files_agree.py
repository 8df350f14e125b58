"""The files of one job say the same: every number of the results file stands in the PDF and in the HTML."""

import json
import re
from io import BytesIO

import pypdf
import pytest

from document.certificate.documents import COMPLETE, job
from installed import registry
from zlmreport import pipeline
from zlmreport.plugin import fixed_number
from zlmreport.plugin.renderer import rounded_pair

STANDARDS = ["iso230-2:1988", "iso230-2:2014", "vdi-dgq-3441", "vdi-vde-2617", "nmtba"]
DECIMALS = 2  # those of the readings


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Return the text of the PDF, the text of the HTML, and the results, of one job by five standards."""
    keys = {**COMPLETE, "evaluate": STANDARDS, "output": {"formats": ["pdf", "html", "json"]}}
    outcome = pipeline.run(job(tmp_path_factory.mktemp("job"), keys), registry())
    content = {document.path.suffix: document.content for document in outcome.documents}
    pages = pypdf.PdfReader(BytesIO(content[".pdf"])).pages
    pdf = " ".join(page.extract_text() for page in pages)
    body = re.sub(r"<(style|svg).*?</\1>", " ", content[".html"].decode(), flags=re.DOTALL)
    html = re.sub(r"<[^>]*>", " ", body)
    return pdf.split(), html.split(), json.loads(content[".json"])


@pytest.fixture(params=[0, 1], ids=["pdf", "html"])
def words(request, files):
    return files[request.param]


def section(words, standard):
    """Return the words from the heading of one standard's section to that of the next."""
    headings = {}  # to where each stands first: the head of a page says it again
    for at in range(len(words)):
        if words[at : at + 2] == ["Results", "by"] and words[at + 2] != "target":
            headings.setdefault(tuple(words[at : at + 4]), at)
    starts = list(headings.values())
    assert len(starts) == len(STANDARDS)
    starts.append(len(words))
    return words[starts[STANDARDS.index(standard)] : starts[STANDARDS.index(standard) + 1]]


def printed(value, more=0):
    return fixed_number(value, DECIMALS + more)


@pytest.mark.parametrize("standard", STANDARDS)
def test_every_parameter_is_printed_as_the_results_file_has_it(files, words, standard):
    (evaluation,) = [each for each in files[2]["evaluations"] if each["standard"] == standard]
    found = section(words, standard)
    for parameter in evaluation["parameters"]:
        value = parameter["value"]
        if (standard, parameter["symbol"]) == ("iso230-2:1988", "B_mean"):
            value = -value  # this edition prints the mean reversal value with the opposite sign
        for text in rounded_pair(value, parameter["expanded_uncertainty"]):
            assert text in found, parameter["symbol"]
        assert printed(parameter["coverage_factor"]) in found, parameter["symbol"]


@pytest.mark.parametrize("standard", STANDARDS)
def test_every_value_by_position_is_printed_as_the_results_file_has_it(files, words, standard):
    (evaluation,) = [each for each in files[2]["evaluations"] if each["standard"] == standard]
    found = section(words, standard)
    others = {"n_fwd", "n_bwd", "target", "U_mean_fwd", "U_mean_bwd", "U_mean"}
    for position in evaluation["positions"]:
        for symbol, value in position.items():
            assert symbol in others or printed(value, more=1) in found, (position["target"], symbol)
        # Both directions have as many readings, and so one uncertainty.
        assert position["U_mean_fwd"] == position["U_mean_bwd"]
        assert rounded_pair(0.0, position["U_mean_fwd"])[1] in found, position["target"]


def test_every_contribution_is_printed_as_the_results_file_has_it(files, words):
    for contribution in files[2]["uncertainty"]["contributions"]:
        size = contribution["standard_uncertainty"]
        assert rounded_pair(size, size)[1] in words, contribution["name"]
        share = 100 * contribution["share"]  # what would be 0.0 is said to be less than 0.1
        assert (fixed_number(share, 1) if share >= 0.1 else "0.1") in words, contribution["name"]


def test_a_number_that_is_not_in_the_results_file_is_not_found(files):
    first = files[2]["evaluations"][0]["parameters"][0]
    value, _ = rounded_pair(first["value"] + 0.01, first["expanded_uncertainty"])
    assert value not in files[0]
