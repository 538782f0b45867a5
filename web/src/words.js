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
}

export { Words };
