// What the scripts find in their page besides the browser's own names.

/** The style sheet, which ../../sim/view/javascript.py puts before the scripts. */
declare const STYLE: string;
/** The style sheet of uPlot, likewise. */
declare const UPLOT_STYLE: string;
/** uPlot, from the package youplot. */
declare const uPlot: any;

interface Window {
  ros2CourseTimeLinks?: boolean;
  ros2CoursePlots?: () => void;
  ros2CourseReplays?: () => void;
  _JUPYTERLAB?: Record<string, any>;
}

interface DocumentEventMap {
  "ros2-course-cursor": CustomEvent<{ run: string, time: number, source: Element, show: boolean }>;
}
