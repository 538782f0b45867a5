// The page: a list of scenes, the language, and one lab. What it shows comes from its address, from
// the file that it was saved in, or is the first scene of the list.
import { el } from "./dom.js";
import { canCompute } from "./engine.js";
import { stateOf } from "./link.js";
import { Words } from "./words.js";

const at = (id) => document.getElementById(id);

function openPage() {
  const main = at("rotdyn-page");
  if (!main) return;
  const { scenes, words } = rotdynParts;
  let language = new Words(document.documentElement.dataset.language || navigator.language).code;

  const speak = () => {
    const said = new Words(language);
    document.documentElement.lang = language;
    document.documentElement.dir = said.list.direction ?? "ltr";
    at("lab-title").textContent = document.title = said.say("page_title");
    at("lab-scene-label").textContent = said.say("choose_scene");
    at("lab-language-label").textContent = said.say("choose_language");
    at("lab-foot").textContent = said.say("page_foot");
    at("lab-scene").replaceChildren(
      el("option", { value: "" }, "–"),
      ...scenes.map((one) => el("option", { value: one.id }, one.title[language] ?? one.title.en)));
    at("lab-language").replaceChildren(...Object.keys(words).map((code) =>
      el("option", { value: code, selected: code === language, lang: code },
        words[code].language)));
  };

  // A lab of a state: { scene: text, title, end, rows, accuracy, ... }.
  const show = (state, id = "") => {
    const { scene, lang, ...settings } = state;
    const lab = el("rotdyn-lab", { scene, settings: JSON.stringify(settings), lang: language,
      page: "" });
    main.replaceChildren(lab);
    at("lab-scene").value = id;
    return lab;
  };

  const settingsOf = (one) =>
    JSON.stringify({ ...one.settings, title: one.title[language] ?? one.title.en });

  const showListed = (id) => {
    const one = scenes.find((scene) => scene.id === id) ?? scenes[0];
    show({ ...JSON.parse(settingsOf(one)), scene: JSON.stringify(one.scene) }, one.id);
  };

  // What is noted, as a function of the words, for another language.
  let noted = null;
  const note = (text) => {
    noted = text;
    at("note").textContent = text ? text(new Words(language)) : "";
  };

  const fallBack = (text) => {
    note(text);
    showListed(scenes[0].id);
  };

  const open = () => {
    note(null);
    const { state, refused } = stateOf(location.hash);
    let own = {};
    try { own = JSON.parse(at("rotdyn-state").textContent) ?? {}; } catch { /* as without one */ }
    const asked = (state ?? own).lang;
    if (Object.hasOwn(words, asked ?? "")) language = asked;
    speak();
    if (refused) return fallBack((said) => said.say(refused));
    const wanted = state ?? (own.scene || own.recording ? own : null);
    if (!wanted) return showListed(/^#scene=([\w-]+)$/.exec(location.hash)?.[1]);
    const lab = show(wanted);
    lab.addEventListener("rotdyn-refused", ({ detail }) =>
      fallBack((said) => said.say("link_refused", { reason: `${
        detail.input ? `${detail.input}: ` : ""}${said.core(detail.reason)}.` })));
  };

  at("lab-scene").addEventListener("change", (event) => {
    if (!event.target.value) return;
    history.replaceState(null, "", `#scene=${event.target.value}`);
    note(null);
    showListed(event.target.value);
  });
  // The lab stays, with the numbers that were set.
  at("lab-language").addEventListener("change", (event) => {
    const id = at("lab-scene").value, lab = main.querySelector("rotdyn-lab");
    language = event.target.value;
    document.documentElement.dataset.language = language;
    speak();
    at("lab-scene").value = id;
    note(noted);
    if (id) lab.setAttribute("settings", settingsOf(scenes.find((scene) => scene.id === id)));
    lab.setAttribute("lang", language);
  });
  addEventListener("hashchange", open);
  open();
  if (!canCompute()) note((said) => said.say("no_core"));
}

// The page as a file with a state in it; without one: whether this can be made.
rotdynParts.page = (state) => {
  const script = document.getElementById("rotdyn-lab");
  if (!script?.textContent || !document.getElementById("rotdyn-page")) return false;
  if (!state) return true;
  const given = JSON.stringify(state).replaceAll("<", "\\u003c");
  return rotdynParts.html.replace("\n{}\n", () => `\n${given}\n`)
    .replace("SCRIPT", () => script.textContent.replace(/^\n/, ""));
};

openPage();

export { openPage };
