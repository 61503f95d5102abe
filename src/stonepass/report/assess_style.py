"""The style sheet of the report of an assessment."""

__all__ = ["STYLE"]

STYLE = """
body { max-width: 46rem; margin: 1.2rem auto; overflow-wrap: anywhere; }
h1 { margin: 0 0 .2rem; font-size: 1.5rem; } h2 { margin: 1.6rem 0 .3rem; font-size: 1.15rem; }
h3 { margin: 0; font-size: 1.05rem; } p { margin: .4rem 0; }
img { width: 100%; max-width: 32rem; height: auto; display: block; margin: .6rem auto; }
a { color: #0b5cad; } .about { color: #4b5563; font-size: .88rem; }
td .about { display: block; font-size: .8rem; white-space: nowrap; }
p.band { background: #fef3c7; border-left: 4px solid #d97706; padding: .4rem .7rem;
  font-weight: 600; }
.alert { background: #fdecea; border-left: 4px solid #b42318; padding: .3rem .9rem .5rem;
  margin: 1rem 0; }
.alert h2 { color: #8f1c13; margin-top: .3rem; }
.decide { background: #eef4fb; border-left: 4px solid #0072b2; padding: .3rem .9rem .5rem;
  margin: 1rem 0; }
.decide h2 { margin-top: .5rem; } .alert h2, .decide h2 { font-size: 1.05rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(14rem, 1fr)); gap: .7rem;
  margin: .6rem 0; }
.card { border: 1px solid #d1d5db; border-radius: .5rem; padding: .6rem .8rem; }
.card p { color: #4b5563; font-size: .85rem; margin: .3rem 0 0; }
.card table { font-size: .92rem; } .card th, .card td { padding: .1rem .5rem .1rem 0; border: 0; }
.card th { font-size: .78rem; font-weight: 500; color: #4b5563; }
.card tr:nth-child(2) td { font-size: 1.1rem; font-weight: 650; }
.facts td:first-child { white-space: nowrap; font-weight: 650; } .facts { margin: .6rem 0; }
tr.group td { border-bottom: 0; padding-top: .6rem; color: #4b5563; }
tr.group b { color: #1f2937; margin-right: .3rem; }
.off { color: #9a3412; font-weight: 600; white-space: nowrap; }
ul { padding-left: 1.1rem; margin: .3rem 0; } li { margin: .25rem 0; }
.inputs { columns: 2 15rem; column-gap: 2rem; padding: 0; list-style: none; font-size: .92rem; }
.inputs li { break-inside: avoid; margin: .15rem 0; } .inputs b { font-weight: 600; }
.sources { font-size: .85rem; } footer { margin-top: 1.5rem; border-top: 1px solid #d1d5db; }
@media (max-width: 30rem) {
  body { padding: 0 .8rem; font-size: 15px; }
  th, td { padding: .35rem .4rem; } .cards { grid-template-columns: 1fr; }
}
@page { size: A4; margin: 13mm 15mm; }
@media print {
  body { font-size: 8.8pt; line-height: 1.3; margin: 0; padding: 0; max-width: none; }
  h1 { font-size: 15pt; } h2 { font-size: 11.5pt; margin: .8rem 0 .2rem; break-after: avoid; }
  h3 { font-size: 10.5pt; } .alert h2, .decide h2 { font-size: 10.5pt; }
  table { font-size: 8.6pt; } th, td { padding: .16rem .4rem; }
  .cards { grid-template-columns: 1fr 1fr; gap: .4rem; } .card { padding: .35rem .6rem; }
  .card p, .about { font-size: 8.2pt; } .card table { font-size: 9pt; } li { margin: .1rem 0; }
  img { max-width: 80mm; max-height: 130mm; margin: .2rem auto; }
  .pair { display: flex; gap: 6mm; } .pair > div { flex: 1 1 0; }
  .pair p { font-size: 8.6pt; } .inputs { font-size: 8.8pt; }
  img, tr, .card, .alert, .decide, .pair { break-inside: avoid; } tr.group { break-after: avoid; }
  td .about { display: inline; margin-left: .6em; }
  .sources { columns: 2; column-gap: 6mm; } .sources > p { break-after: avoid; }
  .sources, footer, td .about { font-size: 7.4pt; } a { color: inherit; text-decoration: none; }
}
"""
