export function validateButton(lab) { return new lab.Widget(); }
