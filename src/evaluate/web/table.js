"use strict";
// Tables that can be sorted by a column, and a filter by verdict.
// <table class="sortable"> has a <thead> of one row and a <tbody>; cells sort by their data-value, a
// number, or else by their text; class "none" marks those without a value. A <div class="filter"
// data-table="ID"> gets a button for each data-verdict of that table's rows; it shows or hides all
// elements with this verdict. Without the script it is a plain table.
(() => {
  const key = (row, column) => {
    const cell = row.cells[column];
    if (!cell || cell.colSpan > 1 || cell.classList.contains("none")) return null;
    if ("value" in cell.dataset) return Number(cell.dataset.value);
    return cell.textContent.trim().toLowerCase();
  };
  const compare = (a, b) => {
    if (typeof a === "string") return a.localeCompare(b, undefined, {numeric: true});
    return a < b ? -1 : a > b ? 1 : 0;
  };

  const sort = (table, column, descending) => {
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => ({row, key: key(row, column)}));
    rows.sort((a, b) => {  // what has no value is last either way
      if (a.key === null || b.key === null) return (a.key === null) - (b.key === null);
      return descending ? compare(b.key, a.key) : compare(a.key, b.key);
    });
    body.append(...rows.map((r) => r.row));
    [...table.tHead.rows[0].cells].forEach((th, i) => {
      if (i === column) th.setAttribute("aria-sort", descending ? "descending" : "ascending");
      else th.removeAttribute("aria-sort");
    });
  };

  for (const table of document.querySelectorAll("table.sortable")) {
    [...table.tHead.rows[0].cells].forEach((th, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...th.childNodes);
      button.addEventListener("click", () =>
        sort(table, column, th.getAttribute("aria-sort") === "ascending"));
      th.append(button);
    });
  }

  for (const bar of document.querySelectorAll(".filter")) {
    const rows = [...document.getElementById(bar.dataset.table).tBodies[0].rows];
    const verdicts = [...new Set(rows.map((row) => row.dataset.verdict))];
    if (verdicts.length < 2) continue;
    const hidden = new Set(), status = document.createElement("span");
    status.setAttribute("role", "status");
    status.className = "soft";
    const buttons = verdicts.map((verdict) => {
      const b = document.createElement("button");
      b.type = "button";
      b.textContent = `${verdict} ${rows.filter((row) => row.dataset.verdict === verdict).length}`;
      b.addEventListener("click", () => {
        if (!hidden.delete(verdict)) hidden.add(verdict);
        update();
      });
      return b;
    });
    const update = () => {
      for (const e of document.querySelectorAll("[data-verdict]"))
        e.hidden = hidden.has(e.dataset.verdict);
      buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(!hidden.has(verdicts[i]))));
      status.textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} shown`;
    };
    bar.setAttribute("role", "group");
    bar.setAttribute("aria-label", "verdicts that are shown");
    bar.append("Show", ...buttons, status);
    update();
  }
})();
