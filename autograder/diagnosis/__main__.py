"""Write the gallery of small cases anew: `python -m autograder.diagnosis`, after a slip was added or changed."""

from autograder.diagnosis.compile import draw_gallery, written
from autograder.diagnosis.gallery import FILE

if __name__ == "__main__":
    FILE.write_bytes(written(draw_gallery()))
    print(f"Wrote {FILE.name}.")
