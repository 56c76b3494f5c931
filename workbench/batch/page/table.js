// Sorts the rows by a column, and shows those that hold what is typed. Values come from the cells alone.
"use strict";
const table = document.querySelector("#cases");
const body = table.tBodies[0];
const search = document.querySelector("#search");

// Numbers before texts, empty cells last, whatever the direction.
function compare(a, b, descending) {
  if (a === "" || b === "") return (a === "") - (b === "");
  const numbers = [Number(a), Number(b)];
  const known = numbers.map((number) => !Number.isNaN(number));
  const order = known[0] && known[1] ? numbers[0] - numbers[1]
    : known[0] !== known[1] ? known[1] - known[0]
    : a.localeCompare(b, undefined, {numeric: true});
  return descending ? -order : order;
}

function sort(header) {
  const descending = header.getAttribute("aria-sort") === "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", descending ? "descending" : "ascending");
  const value = (row) => row.cells[header.cellIndex].dataset.value;
  body.append(...[...body.rows].sort((a, b) => compare(value(a), value(b), descending)));
}

for (const button of table.querySelectorAll("thead button"))
  button.addEventListener("click", () => sort(button.closest("th")));

search.addEventListener("input", () => {
  const text = search.value.toLowerCase();
  for (const row of body.rows) row.hidden = !row.textContent.toLowerCase().includes(text);
});
search.closest("label").hidden = false;
