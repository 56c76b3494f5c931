// Collects what is chosen for the ends, and saves it as answers.json. Values come from the page's elements alone.
"use strict";
const cases = [...document.querySelectorAll(".question")];
const count = document.querySelector("#count");
const text = document.querySelector("#text");
const save = document.querySelector("#save");

const rowsOf = (one) => [...one.querySelectorAll("tr[data-place]")];
const chosen = (row) => row.querySelector("input:checked").value;
const isChanged = (row) => chosen(row) !== row.dataset.proposal;
const counted = (number, noun) => `${number} ${noun}${number === 1 ? "" : "s"}`;

// What is missing for a flow; empty: nothing.
function lackOf(one) {
  const roles = rowsOf(one).map(chosen);
  if (!roles.includes("inlet")) return "Not answered: it has no inlet.";
  if (roles.filter((role) => role !== "closed").length < 2) return "Not answered: a flow needs two openings.";
  return "";
}

// A proposal that nobody has looked at is no answer.
const isRight = (one) => one.querySelector(".right").checked;
const isAnswered = (one) => isRight(one) && lackOf(one) === "";

// Ends that are as proposed need no answer, unless the question is about them.
function answersOf(one) {
  const ends = rowsOf(one).filter((row) => "stated" in row.dataset || isChanged(row))
    .map((row) => ({place_mm: JSON.parse(row.dataset.place), answer: chosen(row)}));
  return {case: one.dataset.case, sha256: one.dataset.sha256, ends};
}

function noteOn(one) {
  if (!isRight(one)) return "";
  const roles = rowsOf(one).map(chosen);
  const number = (role) => roles.filter((other) => other === role).length;
  return lackOf(one) || `${counted(number("inlet"), "inlet")}, ${counted(number("open"), "outlet")}, ${number("closed")} closed.`;
}

function update() {
  for (const one of cases) {
    for (const row of rowsOf(one)) row.classList.toggle("changed", isChanged(row));
    one.querySelector(".note").value = noteOn(one);
  }
  const answered = cases.filter(isAnswered);
  const changed = answered.flatMap(rowsOf).filter(isChanged).length;
  count.value = `${answered.length} of ${counted(cases.length, "case")} answered` +
    (changed === 0 ? "" : `, ${counted(changed, "end")} not as proposed`);
  text.value = `${JSON.stringify({answers: answered.map(answersOf)}, null, 1)}\n`;
  save.disabled = answered.length === 0;
}

function propose() {
  for (const row of cases.flatMap(rowsOf))
    for (const input of row.querySelectorAll("input")) input.checked = input.value === row.dataset.proposal;
  for (const one of cases) one.querySelector(".right").checked = false;
  update();
}

function download() {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text.value], {type: "application/json"}));
  link.download = "answers.json";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

document.addEventListener("change", update);
document.querySelector("#propose").addEventListener("click", propose);
save.addEventListener("click", download);
update();
