// One time cursor for all pictures of a run on a page: replays, plots, and times in text. Pictures of equal runs have
// equal keys. A time in text is a link whose address is `#run-KEY-SECONDS`; without scripts it leads nowhere.

const CURSOR = "ros2-course-cursor";
const TIME_LINK = /^#run-([0-9a-f]{12})-(\d+(?:\.\d+)?)$/;
const AT_CURSOR = 0.005; // s

/** Move the cursor of a run; `source` is the picture that does it, `show` asks others to scroll into view. */
function moveCursor(run, time, source, show = false) {
  if (run) document.dispatchEvent(new CustomEvent(CURSOR, { detail: { run, time, source, show } }));
}

/** Call `onTime` with a time (s) when another picture of the run moves the cursor, while the element is in the page. */
function followCursor(element, run, onTime) {
  const follow = (/** @type {CustomEvent} */ event) => {
    const { detail } = event;
    if (!element.isConnected) document.removeEventListener(CURSOR, follow);
    else if (detail.run === run && detail.source !== element) onTime(detail.time, detail.show);
  };
  document.addEventListener(CURSOR, follow);
}

/** The run and time (s) of a link, or null. */
function timeOf(link) {
  const [, run, seconds] = (link?.getAttribute("href") ?? "").match(TIME_LINK) ?? [];
  return run ? { run, time: Number(seconds) } : null;
}

/** Make the links of this page move their replays; the first script of a page does it for all. */
function followTimeLinks() {
  if (window.ros2CourseTimeLinks) return;
  window.ros2CourseTimeLinks = true;
  document.addEventListener("click", (event) => {
    const link = /** @type {Element} */ (event.target).closest?.("a[href^='#run-']"), at = timeOf(link);
    if (!at) return;
    event.preventDefault();
    event.stopPropagation();
    moveCursor(at.run, at.time, link, true);
  }, { capture: true });
  document.addEventListener(CURSOR, (/** @type {CustomEvent} */ event) => {
    const { run, time } = event.detail;
    for (const link of document.querySelectorAll(`a[href^='#run-${run}-']`)) {
      if (Math.abs(timeOf(link)?.time - time) < AT_CURSOR) link.setAttribute("aria-current", "time");
      else link.removeAttribute("aria-current");
    }
  });
}
