"""Dockerfile and docker-compose.yml parse, are safe, and name what exists: files, settings, commands."""

import fnmatch
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

from service.settings import Settings
from tests.rules.test_settings_documented import settings_of

ROOT = Path(__file__).resolve().parents[2]
INSTRUCTIONS = {"FROM", "WORKDIR", "COPY", "RUN", "ENV", "USER", "VOLUME", "EXPOSE", "HEALTHCHECK", "CMD"}
SETTINGS = {name for name, _, _ in settings_of(Settings)}
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
OURS = sorted(name for name, service in SERVICES.items() if service.get("build") == ".")


def dockerfile() -> list[tuple[str, str]]:
    text = re.sub(r"^#.*\n", "", (ROOT / "Dockerfile").read_text(), flags=re.M).replace("\\\n", " ")
    lines = [line.split(maxsplit=1) for line in text.splitlines() if line.strip()]
    return [(instruction, re.sub(r"\s+", " ", rest)) for instruction, rest in lines]


def arguments(instruction: str) -> list[str]:
    return [rest for name, rest in dockerfile() if name == instruction]


def variables() -> dict[str, str]:
    return dict(pair.split("=", 1) for line in arguments("ENV") for pair in line.split())


def is_sent_to_the_build(path: str) -> bool:
    sent = True
    for rule in (ROOT / ".dockerignore").read_text().splitlines():
        pattern = rule.lstrip("!")
        if (
            rule
            and not rule.startswith("#")
            and any(fnmatch.fnmatch(part, pattern) for part in (path, path.split("/", maxsplit=1)[0]))
        ):
            sent = rule.startswith("!")
    return sent


def test_the_dockerfile_holds_only_known_instructions_and_starts_from_an_image() -> None:
    names = [name for name, _ in dockerfile()]

    assert set(names) <= INSTRUCTIONS
    assert names[0] == "FROM"
    assert all(re.search(r":[\w.-]*\d", image) for image in arguments("FROM"))


@pytest.mark.parametrize("copied", [line for line in arguments("COPY") if not line.startswith("--from")])
def test_what_the_dockerfile_copies_is_there_and_sent_to_the_build(copied: str) -> None:
    for source in copied.split()[:-1]:
        assert (ROOT / source).exists()
        assert is_sent_to_the_build(source.rstrip("/"))


def test_the_image_holds_all_that_the_wheel_is_made_of() -> None:
    wheel = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]
    copied = {word.rstrip("/") for line in arguments("COPY") for word in line.split()}

    assert {*wheel["packages"], *wheel["force-include"]} <= copied


def test_installed_packages_are_the_locked_ones() -> None:
    assert any("--require-hashes -r requirements.lock" in line for line in arguments("RUN"))


def test_the_image_runs_as_nobody_special_and_keeps_its_data_in_a_volume() -> None:
    assert int(arguments("USER")[-1]) > 0
    assert arguments("VOLUME") == [variables()["DMSCAL_DATA_DIR"]]
    assert arguments("EXPOSE") == [variables()["DMSCAL_PORT"]]
    assert variables()["DMSCAL_HOST"] == "0.0.0.0"  # noqa: S104 - inside its own network


def test_the_image_asks_livez_for_its_health() -> None:
    probe = json.loads(arguments("HEALTHCHECK")[0].split("CMD", 1)[1])

    assert probe[:2] == ["python", "-c"]
    assert "/livez" in probe[2]
    compile(probe[2], "healthcheck", "exec")


def test_the_image_starts_the_service() -> None:
    scripts = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["scripts"]
    command = json.loads(arguments("CMD")[-1])

    assert command[0] in scripts
    assert command[1] == "serve"


def test_the_images_variables_are_settings_with_values_that_are_accepted() -> None:
    ours = {name: value for name, value in variables().items() if name.startswith("DMSCAL_")}

    assert set(ours) <= SETTINGS
    Settings(**{name.removeprefix("DMSCAL_").lower(): value for name, value in ours.items()})  # type: ignore[arg-type]


def test_the_default_is_one_service_on_sqlite() -> None:
    always = [name for name, service in SERVICES.items() if "profiles" not in service]

    assert always == ["dmscal"]
    assert "environment" not in SERVICES["dmscal"]


@pytest.mark.parametrize("name", OURS)
def test_every_variable_of_the_compose_file_is_a_setting(name: str) -> None:
    assert set(SERVICES[name].get("environment", {})) <= SETTINGS


def test_the_plant_profile_runs_on_postgresql(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in SERVICES["plant"]["environment"].items():
        monkeypatch.setenv(name, re.sub(r"\$\{\w+:-(\w+)\}", r"\1", value))
    settings = Settings()

    postgres = SERVICES["postgres"]["environment"]
    assert settings.database_url == "postgresql+psycopg://dmscal:dmscal@postgres:5432/dmscal"
    assert (postgres["POSTGRES_USER"], postgres["POSTGRES_DB"]) == ("dmscal", "dmscal")
    assert postgres["POSTGRES_PASSWORD"] in SERVICES["plant"]["environment"]["DMSCAL_DATABASE_URL"]
    assert not settings.jobs.in_service
    assert "ports" not in SERVICES["postgres"]


def test_services_publish_the_images_port_once_each_on_this_computer_only() -> None:
    published = [port for service in SERVICES.values() for port in service.get("ports", [])]

    assert all(re.fullmatch(rf"127\.0\.0\.1:\d+:{variables()['DMSCAL_PORT']}", port) for port in published)
    assert len({port.split(":")[1] for port in published}) == len(published)


def test_services_that_answer_keep_their_data_in_named_volumes() -> None:
    mounts = {name: service.get("volumes", []) for name, service in SERVICES.items()}

    assert {mount.split(":")[0] for found in mounts.values() for mount in found} == set(COMPOSE["volumes"])
    for name in ("dmscal", "plant"):
        assert [mount.split(":")[1] for mount in mounts[name]] == arguments("VOLUME")


def test_services_wait_only_for_services_of_their_profile() -> None:
    for service in SERVICES.values():
        for other in service.get("depends_on", {}):
            assert SERVICES[other].get("profiles", []) == service.get("profiles", [])


def test_a_stop_leaves_the_service_its_grace() -> None:
    grace = Settings.model_fields["shutdown_grace_s"].default

    for name in ("dmscal", "plant", "worker"):
        assert float(SERVICES[name]["stop_grace_period"].rstrip("s")) > grace


def test_commands_of_the_compose_file_exist() -> None:
    modules = [
        service["command"][2] for service in SERVICES.values() if service.get("command", [""])[0] == "python"
    ]
    commands = [
        service["command"][1] for service in SERVICES.values() if service.get("command", [""])[0] == "dmscal"
    ]

    assert [module for module in modules if not (ROOT / f"{module.replace('.', '/')}.py").is_file()] == []
    assert [name for name in commands if f'"{name}"' not in (ROOT / "service" / "cli.py").read_text()] == []
