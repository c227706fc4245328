// Sorting and filtering of the tables, and links to their rows.
"use strict";
(function () {
  const tables = Array.from(document.querySelectorAll("table.data"));

  function keyOf(row, column) {
    const cell = row.cells[column];
    const key = cell.dataset.k;
    if (key === undefined) return cell.textContent;
    // An empty key is a value that does not exist; it stays last in both directions.
    return key === "" ? null : Number(key);
  }

  function compare(a, b) {
    if (typeof a === "number" && typeof b === "number") return a < b ? -1 : a > b ? 1 : 0;
    return String(a).localeCompare(String(b), "en", { numeric: true });
  }

  function sortBy(table, column) {
    const heads = Array.from(table.tHead.rows[0].cells);
    const descending = heads[column].getAttribute("aria-sort") === "ascending";
    heads.forEach((head) => head.removeAttribute("aria-sort"));
    heads[column].setAttribute("aria-sort", descending ? "descending" : "ascending");
    const sign = descending ? -1 : 1;
    const rows = Array.from(table.tBodies[0].rows, (row) => ({ row, key: keyOf(row, column) }));
    rows.sort((a, b) => {
      if (a.key === null || b.key === null) return (a.key === null) - (b.key === null);
      return sign * compare(a.key, b.key);
    });
    table.tBodies[0].append(...rows.map((entry) => entry.row));
  }

  tables.forEach((table) => {
    Array.from(table.tHead.rows[0].cells).forEach((head, column) => {
      head.querySelector("button").addEventListener("click", () => sortBy(table, column));
    });
  });

  const lines = tables.flatMap((table) =>
    Array.from(table.tBodies[0].rows, (row) => ({
      row,
      // A function's name is looked for as a whole word first: "sin" must not be drowned by "asinh".
      text: " " + Array.from(row.cells, (cell) => cell.textContent.toLowerCase()).join(" ") + " ",
    }))
  );

  function filter(text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    const whole = words.filter((word) => lines.some((line) => line.text.includes(" " + word + " ")));
    let shown = 0;
    lines.forEach((line) => {
      const wanted = words.every((word) => line.text.includes(whole.includes(word) ? " " + word + " " : word));
      line.row.hidden = !wanted;
      if (wanted) shown += 1;
    });
    document.getElementById("count").textContent = words.length ? shown + " of " + lines.length + " rows" : "";
  }

  // Every row can be linked to: by its table and what it says first.
  const taken = new Set();
  tables.forEach((table) => {
    Array.from(table.tBodies[0].rows).forEach((row) => {
      const first = row.cells[0];
      if (!first) return;
      if (!row.id) {
        const words = [first, row.cells[1]].filter((cell, i) => cell && (i === 0 || cell.querySelector("code")));
        let name = table.id + "." + words.map((cell) => cell.textContent.trim().replace(/\s+/g, ".")).join(".");
        for (let n = 2, stem = name; taken.has(name); ++n) name = stem + "." + n;
        taken.add(name);
        row.id = name;
      }
      const link = document.createElement("a");
      link.className = "here";
      link.href = "#" + encodeURIComponent(row.id);
      link.textContent = "#";
      link.setAttribute("aria-label", "link to this row");
      first.append(link);
    });
  });

  // A cell that opens: what is known of it, the command that shows it, the way to its distribution.
  const dialog = document.getElementById("cell");
  const command = document.getElementById("cell-command");
  const leads = document.getElementById("cell-distribution");
  let opened = null;
  document.addEventListener("click", (event) => {
    const button = event.target.closest(".cell");
    if (!button) return;
    opened = button.closest("td");
    document.getElementById("cell-text").textContent = opened.title;
    command.textContent = opened.dataset.command;
    leads.hidden = !opened.dataset.row || !document.getElementById("row");
    dialog.showModal();
  });
  document.getElementById("cell-copy").addEventListener("click", () => {
    const range = document.createRange();
    range.selectNodeContents(command);
    const selection = window.getSelection();
    selection.removeAllRanges();
    selection.addRange(range);
    // A page from the disk may not have the clipboard; what is selected can be copied by hand all the same.
    if (navigator.clipboard) navigator.clipboard.writeText(command.textContent).catch(() => {});
  });
  leads.addEventListener("click", () => {
    dialog.close();
    const choice = document.getElementById("row");
    choice.value = opened.dataset.row;
    choice.dispatchEvent(new Event("change"));
    document.getElementById("distribution").scrollIntoView();
  });

  // A link may lead to a row of a closed list, or of one that the filter hides.
  function show() {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    const closed = target.closest("details");
    if (closed) closed.open = true;
    const row = target.closest("tr");
    if (row) row.hidden = false;
    if (closed || row) target.scrollIntoView({ block: "center", inline: "start" });
  }
  window.addEventListener("hashchange", show);
  show();

  const box = document.getElementById("filter");
  let waiting = 0;
  box.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => filter(box.value), 120);
  });
})();
