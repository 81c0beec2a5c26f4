// SPDX-License-Identifier: GPL-2.0-or-later
// The search lists the reference of scenes before other pages that have a word equally often, and pages
// for developers last: Sphinx would go by the alphabet. The other numbers are its own.
var Scorer = {
  score: ([page, , , , score]) => score + (page === "docs/scene" ? 2 : 0) -
    (/^(CHANGELOG|CONTRIBUTING)$|^docs\/(lab|adding_|cpp_|references|stability)/.test(page) ? 3 : 0),
  objNameMatch: 11, objPartialMatch: 6, objPrio: { 0: 15, 1: 5, 2: -5 }, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
