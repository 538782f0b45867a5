// What pkgdown's script asks of two libraries: the contents of a page, and a bar that stays.
window.jQuery.fn.headroom = function () { return this; };
window.Toc = {
  init({ $nav, $scope }) {
    const list = document.createElement("ul");
    list.className = "nav flex-column";
    const own = $scope.filter("h2, h3");
    for (const heading of (own.length ? own : $scope.find("h2, h3")).toArray()) {
      const section = heading.closest("[id]");
      if (!section) continue;
      const link = document.createElement("a");
      link.className = "nav-link";
      link.href = `#${section.id}`;
      link.textContent = heading.textContent.replace(/\s+$/, "");
      const item = document.createElement("li");
      item.className = heading.tagName === "H3" ? "ms-3" : "";
      item.append(link);
      list.append(item);
    }
    $nav.append(list);
  }
};

document.addEventListener("DOMContentLoaded", () => {
  document.querySelector("nav.navbar")?.setAttribute("aria-label", document.title);
});
