# Grades wherever there is Docker; `autograder doctor` prints the two commands for it.
# The lock on submissions is the same inside: it needs no privilege and no namespace from the container.
FROM python:3.13-slim

WORKDIR /opt/slam1d-homework
COPY requirements.lock ./
RUN pip install --no-cache-dir --no-input --no-deps --require-hashes -r requirements.lock

COPY pyproject.toml README.md LICENSE ./
COPY assignment assignment
COPY autograder autograder
COPY reference_solution reference_solution
RUN pip install --no-cache-dir --no-input --no-deps --no-build-isolation .

# On Linux add --user "$(id -u):$(id -g)" to `docker run`, or the results belong to root.
WORKDIR /course
ENTRYPOINT ["autograder"]
