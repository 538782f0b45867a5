// Words of a language, with English for what it lacks.
class Words {
  constructor(wanted) {
    const short = String(wanted || "en").toLowerCase().split("-")[0];
    this.code = short in rotdynParts.words ? short : "en";
    this.list = rotdynParts.words[this.code];
    // Numbers are written as the place does where only the words lack.
    try {
      this.language = Intl.NumberFormat.supportedLocalesOf([wanted])[0] ?? this.code;
      if (!this.language.toLowerCase().startsWith(this.code)) this.language = this.code;
    } catch {
      this.language = this.code;
    }
    this.comma = new Intl.NumberFormat(this.language).format(0.5).includes(",");
  }

  // The text of a key; {name} is put in. `other`: where no language has the key.
  say(key, values = {}, other = key) {
    const text = this.list[key] ?? rotdynParts.words.en[key] ?? other;
    return text.replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
  }

  // A text of the core in this language: `core.` and its English words are the key, where {name}
  // stands for a part that is such a text itself, a number, a name, or a list of them.
  core(text) {
    return this.code === "en" || !text ? text : this.translated(text) ?? text;
  }

  translated(text) {
    const exact = this.list[`core.${text}`];
    if (exact !== undefined) return exact;
    if (/^-?(\d[\d.]*(e[-+]?\d+)?|[Ii]nf|NaN)$/.test(text)) {
      return this.comma ? text.replace(".", ",") : text;
    }
    if (/^[a-z]\w*$/.test(text)) return text; // the name of a model or of an input
    for (const { key, shape, names } of this.patterns()) {
      const found = shape.exec(text);
      const parts = found?.slice(1).map((part) => this.translated(part));
      if (!parts || parts.includes(undefined)) continue;
      return this.say(key, Object.fromEntries(names.map((name, i) => [name, parts[i]])));
    }
    for (const between of [" and ", ", "]) {
      const at = text.lastIndexOf(between);
      if (at < 0) continue;
      const [before, after] = [text.slice(0, at), text.slice(at + between.length)]
        .map((part) => this.translated(part));
      if (before && after) return before + this.list[`core.${between}`] + after;
    }
    return undefined;
  }

  // The keys with parts, the longest first.
  patterns() {
    this.shapes ??= Object.keys(this.list).filter((key) => /^core\..*\{/.test(key))
      .sort((a, b) => b.length - a.length).map((key) => ({
        key, names: [...key.matchAll(/\{(\w+)\}/g)].map((found) => found[1]),
        shape: new RegExp(`^${key.slice(5).replace(/[.*+?^$()|[\]\\]/g, "\\$&")
          .replace(/\{\w+\}/g, "(.+?)")}$`)
      }));
    return this.shapes;
  }
}

export { Words };
