// A lab as a link: the version, the scene and what else brings it back, behind the #.
const linkVersion = "1", maxLink = 2000;
const parts = ["title", "start", "end", "rows", "accuracy", "lang"];

// The text behind the #, or null where it would be too long.
function linkOf(address, state) {
  const query = new URLSearchParams({ lab: linkVersion });
  for (const name of parts) {
    if (state[name] !== null && state[name] !== undefined) query.set(name, state[name]);
  }
  query.set("scene", state.scene);
  const link = `${address.replace(/#.*/, "")}#${query}`;
  return link.length <= maxLink ? link : null;
}

// { state }, { refused: a key of words }, or {} where there is none.
function stateOf(hash) {
  const query = new URLSearchParams(hash.replace(/^#/, ""));
  if (!query.has("lab")) return {};
  if (query.get("lab") !== linkVersion) return { refused: "link_version" };
  const state = { scene: query.get("scene") ?? "" };
  for (const name of parts) if (query.has(name)) state[name] = query.get(name);
  for (const [key] of query) {
    if (key !== "lab" && key !== "scene" && !parts.includes(key)) return { refused: "link_key" };
  }
  return { state };
}

export { linkOf, stateOf };
