"""What is missing for safe grading on a machine, and the exact commands that grade elsewhere."""

from __future__ import annotations

# All are typed in the folder of this repository, where the Dockerfile is, with the uploads in `uploads` below it.
CONTAINER = (
    "docker build -t slam1d-homework .",
    'docker run --rm --network none {user}-v "{here}:/course" slam1d-homework grade uploads -o graded',
)
WSL = (
    "wsl --install -d Ubuntu",
    "wsl -d Ubuntu -u root -- apt-get update",
    "wsl -d Ubuntu -u root -- apt-get install -y make python3-venv",
    "wsl -d Ubuntu -- make demo",
    "wsl -d Ubuntu -- .venv/bin/autograder grade uploads -o graded",
)
PROCESSORS = ("x86_64", "aarch64")  # as the filter has a table for


def missing(level: str) -> str:
    """Name what a level lacks."""
    return {
        "full": "nothing",
        "seccomp": "Landlock, the second lock: it needs Linux 5.13 or newer, in a container Docker 23 or newer",
    }.get(level, "the lock: submissions could read and change whatever you can")


def what_to_do(level: str, minimum: str, system: str, machine: str) -> list[str]:
    """Say in lines what to do on a machine that confines at a level, where a course demands another.

    Parameters
    ----------
    level : str
        What the machine gives: "full", "seccomp" or "none".
    minimum : str
        What the course demands.
    system, machine : str
        As `platform.system()` and `platform.machine()` say.
    """
    if level == "full" or (level == "seccomp" and minimum != "full"):
        return ["Nothing: this machine is ready to grade."]
    if level == "seccomp":
        return [
            "The course demands full, so `grade` refuses here. Grade on a newer kernel, or set",
            'minimum = "seccomp" in the section [confinement] of the course file: the filter alone holds.',
        ]
    return [*_elsewhere(system, machine), "Here `grade` refuses; --allow-unconfined is for code that you trust."]


def _elsewhere(system: str, machine: str) -> list[str]:
    if system == "Windows":
        return [
            "Grade in WSL2. In PowerShell, in the folder of this repository:",
            *_indented(WSL),
            "Or in a container:",
            *_indented(CONTAINER, here="${PWD}"),
        ]
    if system == "Linux" and machine not in PROCESSORS:
        return [f"Grade on a processor of another kind ({' or '.join(PROCESSORS)}); this one is {machine}."]
    if system == "Linux":
        return [
            "Grade where the kernel has system call filters (seccomp): any Linux of the last ten years, or a",
            "container on it, with the profile that Docker gives it. In the folder of this repository:",
            *_indented(CONTAINER, here="$PWD"),
        ]
    return [
        "Grade in a Linux container. In the folder of this repository:",
        *_indented(CONTAINER, here="$PWD"),
    ]


def _indented(commands: tuple[str, ...], here: str = "") -> list[str]:
    user = '--user "$(id -u):$(id -g)" ' if here == "$PWD" else ""  # else the results would belong to root
    return [f"  {command.replace('{here}', here).replace('{user}', user)}" for command in commands]
