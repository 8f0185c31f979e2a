"""What a submission may put into its outputs to reach who reads the feedback: `window.stolen` counts it."""

import base64
import json
import zlib

from IPython.display import HTML, Javascript, Latex, Markdown, display

STEAL = "window.stolen=(window.stolen||0)+1"
ELSEWHERE = "https://collector.invalid/seen"
PNG = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="


def forged(data):
    """A replay of data that no recording gave."""
    return f'<div class="ros2-replay" data-replay="{data}" onclick="{STEAL}"><b>forged</b></div>'


def packed(data):
    """The data as the player reads it."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


WORDS = f"</script><script>{STEAL}</script><img src=x onerror='{STEAL}'>"
EVIL = {
    "version": 1, "speed": 1, "end": 1, "world": None, "stamps": [], "tracks": [], "scans": [],
    "marks": [[0, "navbar-fixed-top", WORDS, None]],
    "logs": [[0, "modal-backdrop", WORDS, None]],
    "topics": [[WORDS, WORDS, "1"]],
}  # fmt: skip
SHOWN = {**EVIL, "marks": [[0, "contact", WORDS, None]], "logs": [[0, "INFO", WORDS, None]]}
HUGE = packed(b"[" + b"1," * 100_000_000 + b"1]")  # 200 MB once it is unpacked

FORGED = [
    "",
    "QUJD",
    "A" * 4000,
    packed([]),
    packed({**SHOWN, "end": 1e300}),
    HUGE,
    packed(EVIL),
    packed(SHOWN),
]
HOSTILE = [
    f"<script>{STEAL}</script>",
    f"<ScRiPt >{STEAL}</sCrIpT >",
    f'<img src="x" onerror="{STEAL}">',
    f'<img src="{ELSEWHERE}"><link rel="stylesheet" href="{ELSEWHERE}">',
    f'<style>@import "{ELSEWHERE}"; body {{ background: url({ELSEWHERE}) }}</style>',
    f'<div style="background: url({ELSEWHERE}); background-color: url({ELSEWHERE}); position: fixed">x</div>',
    f'<svg onload="{STEAL}"><script>{STEAL}</script></svg>',
    f'<iframe srcdoc="<script>parent.{STEAL}</script>"></iframe>',
    f'<details open ontoggle="{STEAL}"><summary>x</summary></details>',
    f'<a href="javascript:{STEAL}" id="forged">x</a>',
    f'<math><mtext><table><mglyph><style><img src=x onerror="{STEAL}"></style></mglyph></table></math>',
    f'<noscript><p title="</noscript><img src=x onerror={STEAL}>"></noscript>',
    f'<meta http-equiv="refresh" content="0; url={ELSEWHERE}"><base href="{ELSEWHERE}/">',
    '<div class="navbar-fixed-top" style="height: 100000px; background-color: red">over all</div>',
]

for page in [*HOSTILE, *map(forged, FORGED)]:
    display(HTML(page))
    display(Markdown(page))
display(HTML(HOSTILE[0]), metadata={"text/html": {"isolated": True}})
display(Javascript(STEAL))
display(Latex(rf"$\href{{javascript:{STEAL}}}{{x}}$"))
for kind in ("image/png", "image/jpeg"):
    for bad in (f"1 onload={STEAL}", f"1 onerror={STEAL}"):
        settings = {"width": bad, "height": bad, "alt": f'"><img {bad}>'}
        display({kind: PNG}, raw=True, metadata={kind: settings})
    display({kind: PNG}, raw=True, metadata={"filenames": {kind: ELSEWHERE}})
view = {"model_id": "1", "version_major": 2, "version_minor": 0}
display({"application/vnd.jupyter.widget-view+json": view, "text/html": HOSTILE[0]}, raw=True)
display({"text/vnd.mermaid": f"</pre><script>{STEAL}</script>"}, raw=True)
display({"image/svg+xml": f'<svg xmlns="http://www.w3.org/2000/svg" onload="{STEAL}"></svg>'}, raw=True)
print(HOSTILE[0])
