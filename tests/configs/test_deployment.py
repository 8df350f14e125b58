"""The examples of services: what systemd checks, what Kubernetes knows, and commands that there are."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from configparser import ConfigParser
from pathlib import Path
from typing import Any

import pytest
import yaml

from environments import ROOT
from processes import PATIENCE
from zlmreport.cli import main

FLEET = ROOT / "configs" / "fleet"
#: The fields of batch/v1 CronJob that the example uses, group by group (kubernetes.io/docs/reference).
FIELDS = {
    "": {"apiVersion", "kind", "metadata", "spec"},
    "metadata": {"name"},
    "spec": {
        *("schedule", "concurrencyPolicy", "startingDeadlineSeconds", "successfulJobsHistoryLimit"),
        *("failedJobsHistoryLimit", "jobTemplate"),
    },
    "spec.jobTemplate": {"spec"},
    "spec.jobTemplate.spec": {"backoffLimit", "activeDeadlineSeconds", "podFailurePolicy", "template"},
    "spec.jobTemplate.spec.template": {"spec"},
    "spec.jobTemplate.spec.template.spec": {"restartPolicy", "securityContext", "containers", "volumes"},
}
INSTRUCTIONS = {"FROM", "RUN", "COPY", "USER", "ENV", "WORKDIR", "ENTRYPOINT", "CMD"}


def unit(name: str) -> ConfigParser:
    parser = ConfigParser(strict=True, interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]  # names keep their case
    parser.read_string((FLEET / name).read_text(encoding="utf-8"))
    return parser


def test_the_service_is_limited_and_begins_again_only_after_what_is_abnormal() -> None:
    service = unit("nightly.service")["Service"]
    assert service["Restart"] == "on-abnormal"
    assert {"TimeoutStartSec", "MemoryMax", "TasksMax"} <= set(service)


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="systemd is not installed")
def test_systemd_has_nothing_against_the_units(tmp_path: Path) -> None:
    for name in ("nightly.service", "nightly.timer"):
        text = (FLEET / name).read_text(encoding="utf-8")
        (tmp_path / name).write_text(text.replace("/opt/zlmreport/bin/zlmreport", sys.executable))
    command = ["systemd-analyze", "verify", "--man=no", *map(str, tmp_path.glob("nightly.*"))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert not re.findall(rf"^.*{tmp_path}.*$|^.*nightly\.\w+:.*$", done.stderr, re.MULTILINE)


@pytest.fixture(scope="module")
def cron() -> Any:
    return yaml.safe_load((FLEET / "cronjob.yml").read_text(encoding="utf-8"))


def at(tree: Any, path: str) -> Any:
    for key in path.split(".") if path else ():
        tree = tree[key]
    return tree


@pytest.mark.parametrize("path", FIELDS)
def test_the_cron_job_has_fields_that_there_are(path: str, cron: Any) -> None:
    assert set(at(cron, path)) <= FIELDS[path]


def test_the_cron_job_never_runs_twice_and_is_limited(cron: Any) -> None:
    assert (cron["apiVersion"], cron["kind"]) == ("batch/v1", "CronJob")
    assert cron["spec"]["concurrencyPolicy"] == "Forbid"
    job = cron["spec"]["jobTemplate"]["spec"]
    assert job["activeDeadlineSeconds"] > 0
    pod = job["template"]["spec"]
    (night,) = pod["containers"]
    assert pod["restartPolicy"] == "Never"  # the only one with a policy on exit codes
    assert pod["securityContext"]["runAsNonRoot"] is True
    assert set(night["resources"]["limits"]) == {"cpu", "memory"}
    assert {each["name"] for each in night["volumeMounts"]} == {each["name"] for each in pod["volumes"]}
    (rule,) = job["podFailurePolicy"]["rules"]
    assert rule["onExitCodes"]["containerName"] == night["name"]


def test_the_container_is_pinned_and_nobody_in_it_is_root() -> None:
    text = (FLEET / "Containerfile").read_text(encoding="utf-8")
    lines = [line for line in text.replace("\\\n", " ").splitlines() if line and not line.startswith("#")]
    known = [line.partition(" ")[::2] for line in lines]
    assert {word for word, _ in known} == INSTRUCTIONS
    of = dict(known)
    assert re.fullmatch(r"\S+:\d[\w.-]+", of["FROM"])
    assert re.fullmatch(r"[1-9]\d*:[1-9]\d*", of["USER"])
    assert "libpango-1.0-0" in text


def test_their_commands_and_options_exist(cron: Any, capsys: pytest.CaptureFixture[str]) -> None:
    service = unit("nightly.service")["Service"]
    pod = cron["spec"]["jobTemplate"]["spec"]["template"]["spec"]
    commands = [service["ExecStart"].split()[1:], service["ExecStopPost"].split()[1:]]
    commands.append(pod["containers"][0]["args"])
    for command in commands:
        words = command[: 2 if command[1] == "report" else 1]
        main([*words, "--help"])
        described = capsys.readouterr().out
        assert all(option in described for option in command if option.startswith("--"))
