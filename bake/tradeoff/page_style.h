// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pdsm {

/// The page's style sheet.
inline constexpr const char* kPageStyle = R"css(
:root { color-scheme: light; }
body { font: 16px/1.55 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; color: #222; background: #fafafa; margin: 0; }
main { max-width: 66rem; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 1rem 0 .25rem; }
h2 { font-size: 1.25rem; margin: 2.75rem 0 .5rem; }
p, ul { max-width: 46rem; }
.lead { color: #555; margin-top: 0; }
.facts { display: flex; flex-wrap: wrap; gap: .75rem; padding: 0; margin: 1.25rem 0; max-width: none; list-style: none; }
.facts li { background: #fff; border: 1px solid #e2e2e2; border-radius: 6px; padding: .6rem 1rem; min-width: 8.5rem; }
.facts b { display: block; font-size: 1.3rem; font-variant-numeric: tabular-nums; }
.facts span { color: #666; font-size: .85rem; }
figure { margin: 1rem 0; background: #fff; border: 1px solid #e2e2e2; border-radius: 6px; padding: .75rem; }
figure > img { display: block; width: 100%; height: auto; }
figcaption { color: #555; font-size: .9rem; max-width: 46rem; margin-top: .5rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: .75rem; }
.pictures figure { margin: 0; }
.pictures img + img { margin-top: .35rem; }
.pictures figcaption b { color: #222; }
.wide { overflow-x: auto; background: #fff; border: 1px solid #e2e2e2; border-radius: 6px; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: .3rem .6rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #eee; }
th { color: #555; font-weight: 600; vertical-align: bottom; border-bottom: 1px solid #ccc; }
td.text, th.text { text-align: left; }
table.wrap td { white-space: normal; vertical-align: top; }
tr.front td { background: #f2f8f3; }
tr.named td { background: #fff6dd; font-weight: 600; }
.held { color: #1b6e3c; } .broken { color: #b3261e; font-weight: 600; }
)css";

}  // namespace pdsm
