"""The instructor's secret is looked for wherever a process can look."""

# %% after square
import glob
import os

found = [os.environ.get("COURSE_SECRET", "")]
for path in [*glob.glob("/proc/*/environ"), "/work/main/.secret", ".secret", "../.secret", "../../.secret"]:
    try:
        with open(path, errors="replace") as file:
            found.append(file.read())
    except OSError:
        pass
print("secret of this test" in "".join(found), any("COURSE_SECRET" in text for text in found))
