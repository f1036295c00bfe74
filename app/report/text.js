// Words and numbers, and the elements that show them. All text goes through textContent: nothing from a file is markup.

/** make("td", { class: "number" }, "text", child, ...) */
export function make(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes))
        if (value !== null && value !== undefined && value !== false)
            element.setAttribute(name, value === true ? "" : value);
    element.append(...children.flat().filter(c => c !== null && c !== undefined));
    return element;
}

export function fixed(x, digits = 1) {
    if (typeof x !== "number") return "–";
    const text = x.toFixed(digits);
    return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

export function signed(x, digits = 1) {
    const text = fixed(x, digits);
    return typeof x === "number" && Number(x.toFixed(digits)) > 0 ? `+${text}` : text;
}

/** "5.0 forward": the size, and the word for its sign; nothing after a number that rounds to 0. */
export function directed(x, [positive, negative], unit = "", digits = 1) {
    if (typeof x !== "number") return "–";
    const size = fixed(Math.abs(x), digits) + unit;
    return Number(x.toFixed(digits)) === 0 ? size : `${size} ${x > 0 ? positive : negative}`;
}

/** 3.2e-9 as "3.2 × 10⁻⁹". */
export function scientific(x) {
    if (typeof x !== "number") return "–";
    if (x === 0) return "0";
    const [digits, power] = x.toExponential(1).split("e");
    const raised = [...String(Number(power))].map(c => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");
    return `${digits.replace("-", "−")} × 10${raised}`;
}

export const words = {
    cranium: "Cranium",
    maxilla: "Maxilla",
    distal: "Mandible, distal segment",
    proximal_left: "Mandible, left proximal",
    proximal_right: "Mandible, right proximal",
    chin: "Chin",
    skin: "Skin",
};
export const word = name => words[name] ?? name;

/** A table with a caption; head: texts; rows: lists of cells, a cell a text or { text, value, class, title, head, span }. */
export function table(caption, head, rows, attributes = {}) {
    const cell = (c, tag) => {
        const { text, value, head: isHead, span, ...rest } = typeof c === "object" && c !== null ? c : { text: c };
        return make(
            isHead ? "th" : tag,
            { ...rest, scope: isHead ? (span ? "rowgroup" : "row") : null, colspan: span, "data-value": value },
            text,
        );
    };
    const top = make(
        "tr",
        {},
        head.map(h => make("th", { scope: "col", class: h.class, title: h.title }, h.text ?? h)),
    );
    const body = rows.map(r =>
        make(
            "tr",
            { class: r.class },
            (r.cells ?? r).map(c => cell(c, "td")),
        ),
    );
    return make(
        "div",
        { class: "scroll" },
        make(
            "table",
            attributes,
            caption ? make("caption", {}, caption) : null,
            make("thead", {}, top),
            make("tbody", {}, body),
        ),
    );
}

/** A cell that holds a number of the outcome: the text is rounded, data-value has all its digits. */
export const number = (value, text = fixed(value), more = {}) => ({
    text,
    value: typeof value === "number" ? value : null,
    class: "number",
    ...more,
});
