"""How well the texts of a page can be read: the contrast with what lies behind them, as WCAG 2 has it."""

from playwright.sync_api import Page

# Each text with less than 4.5 : 1 (3 : 1 if it is large): its contrast, colors, classes and first words.
# Not measured: disabled controls, as WCAG says; a legend's marks: they look like what they stand for and have
# an edge; texts before a gradient or a picture; text that isn't shown.
POOR_TEXTS = r"""within => {
    const NOT_MEASURED = "script, style, :disabled, [inert], [aria-hidden=true]";
    const numbers = (color) => {
        const [red, green, blue, alpha = 1] = (color.match(/[\d.]+/g) ?? [0, 0, 0, 0]).map(Number);
        const scale = color.startsWith("color(srgb") ? 255 : 1;
        return [red * scale, green * scale, blue * scale, alpha];
    };
    const over = ([r, g, b, a], below) => [r, g, b].map((part, index) => a * part + (1 - a) * below[index]);
    const brightness = (color) => {
        const [red, green, blue] = color.map((part) => part / 255)
            .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    };
    const contrast = (one, other) => {
        const [low, high] = [brightness(one), brightness(other)].sort((a, b) => a - b);
        return (high + 0.05) / (low + 0.05);
    };
    const ancestors = (element) => element ? [...ancestors(element.parentElement), element] : [];
    const poor = [];
    const texts = document.createTreeWalker(document.querySelector(within), NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
        const element = texts.currentNode.parentElement, words = texts.currentNode.textContent.trim();
        const range = document.createRange();
        range.selectNodeContents(texts.currentNode);
        const { width, height } = range.getBoundingClientRect();
        if (!words || width < 2 || height < 2 || element.closest(NOT_MEASURED)) continue;
        const style = getComputedStyle(element);
        if (style.visibility === "hidden") continue;
        let behind = [255, 255, 255], picture = false, opacity = 1;
        const drawn = numbers(style.color);
        for (const each of ancestors(element)) {
            const { backgroundColor, backgroundImage, opacity: own } = getComputedStyle(each);
            opacity *= Number(own);
            const [r, g, b, a] = numbers(backgroundColor);
            picture = (picture && a < 1) || backgroundImage !== "none";
            behind = over([r, g, b, a * opacity], behind);
        }
        if (picture || opacity === 0) continue;
        const front = over([drawn[0], drawn[1], drawn[2], drawn[3] * opacity], behind);
        const size = parseFloat(style.fontSize);
        const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
        const ratio = contrast(front, behind);
        if (ratio >= (large ? 3 : 4.5)) continue;
        const names = [element, element.parentElement].map((each) => each?.getAttribute("class"));
        const seen = [front, behind].map((color) => color.map(Math.round));
        const where = names.filter(Boolean).join(" < ");
        poor.push([ratio.toFixed(1), ...seen, where, words.slice(0, 30)].join(" | "));
    }
    return [...new Set(poor)];
}"""


def poor_texts(page: Page, within: str = "body") -> list[str]:
    """A line for each text in an element that has less contrast than WCAG's level AA asks for.

    within: a CSS selector.
    """
    return page.evaluate(POOR_TEXTS, within)
