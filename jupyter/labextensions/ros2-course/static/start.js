export function keepFresh() {}
