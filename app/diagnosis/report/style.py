"""The page's look: calm on a screen, true on A4; colours that stay apart for colour-blind eyes."""

#: Of the pictures alone; one rule a line, so that the pendant can confine them to its plots. Every colour has a name:
#: here it is paper's, in the pendant its theme's (`panel.css`).
PICTURES = """
svg{display:block;width:100%;height:auto;font-family:inherit}
.tick{font-size:9px;fill:var(--soft)}.label{font-size:10px;fill:var(--ink)}.value{font-size:10px;fill:var(--ink)}
.end{text-anchor:end}.mid{text-anchor:middle}
.grid{stroke:var(--grid);stroke-width:.8}.zero{stroke:var(--noise);stroke-width:.9}
.fill-before{fill:var(--before)}.fill-after{fill:var(--after)}.fill-given{fill:var(--given)}
.noise{stroke:var(--noise);stroke-width:1.4;stroke-dasharray:5 3}
.dot{fill:none;stroke-linecap:round;stroke-width:3.2}.dot.before{stroke:var(--before);opacity:.45}
.dot.after{stroke:var(--after);opacity:.55}.dot.place{stroke:var(--ink);stroke-width:2.2;opacity:.6}
.mean,.halo,.trace,.stroke{fill:none;stroke-linejoin:round;stroke-linecap:round}
.halo{stroke:var(--paper);stroke-width:4.6}.mean{stroke-width:2.2}
.stroke{stroke-width:1.2}.trace{stroke-width:1}.trace.measured{stroke:var(--ink);stroke-width:1.1}
.trace.missed{stroke:var(--ink);stroke-width:.6;opacity:.55}
.mean.before,.stroke.before,.trace.before{stroke:var(--before)}
.mean.after,.stroke.after,.trace.after{stroke:var(--after)}.stroke.aside{stroke:var(--noise)}
.flag{fill:var(--bad)}.flag-number{font-size:9px;font-weight:600;fill:#fff}
.window{fill:var(--window)}.now{stroke:var(--bad);stroke-width:1.4}
"""

CSS = (
    """
:root{--ink:#1c2730;--soft:#5b6873;--rule:#d9dfe4;--paper:#fff;--tint:#f5f7f9;
--before:#d97b16;--after:#1866ad;--noise:#7b8794;--good:#1d7a4c;--warn:#a15c00;--bad:#a3262a;
--grid:#e6eaee;--window:#f3d9d9;--given:#2f8f5b}
*{box-sizing:border-box}
html{background:#e9edf0;-webkit-print-color-adjust:exact;print-color-adjust:exact}
body{margin:0 auto;max-width:210mm;background:var(--paper);color:var(--ink);padding:15mm 16mm 14mm;
font:10.2pt/1.46 "Inter","Segoe UI","Helvetica Neue",Arial,"Noto Sans","DejaVu Sans",sans-serif}
header{border-bottom:2px solid var(--ink);padding-bottom:9px;margin-bottom:13px}
.brand{font-weight:600;color:var(--soft);font-size:9pt;display:flex;justify-content:space-between}
h1{font-size:19pt;line-height:1.2;margin:5px 0 3px;font-weight:650;overflow-wrap:anywhere}
h2{font-size:12.4pt;margin:20px 0 6px;font-weight:650;break-after:avoid}
h3{font-size:11.4pt;margin:0;font-weight:650}
p{margin:0 0 7px}section>p.small{break-after:avoid;break-inside:avoid}.soft{color:var(--soft)}.small{font-size:8.8pt}
.meta{color:var(--soft);font-size:9.4pt}
.verdict{border-left:6px solid var(--tone);background:var(--tint);padding:10px 14px;margin:0 0 13px;break-inside:avoid}
.verdict b{color:var(--tone);font-size:12.4pt;display:block}
.clean{--tone:var(--good)}.named{--tone:var(--after)}.partly{--tone:var(--warn)}.unexplained{--tone:var(--bad)}
.key{display:flex;flex-wrap:wrap;gap:4px 18px;font-size:8.8pt;color:var(--soft);margin:2px 0 4px;break-after:avoid}
.key i{display:inline-block;width:16px;height:8px;margin-right:5px;border-radius:2px;vertical-align:1px}
.key i.b{background:var(--before)}.key i.a{background:var(--after)}.key i.m{background:var(--ink)}
.key i.g{background:#2f8f5b}.key i.w{background:#f3d9d9}
.key i.n{height:0;border-top:2px dashed var(--noise);vertical-align:3px;border-radius:0}
.sum{font-size:13pt;line-height:1.35;font-weight:600;margin:2px 0 8px}.beside{margin:6px 0 10px}
.budget figure+.key{margin-top:10px}
.family{border-left:6px solid var(--tone);margin:0 0 9px;padding:1px 0 1px 11px}
summary{cursor:default;break-after:avoid}.family>summary{display:flex;gap:12px;align-items:baseline;padding:3px 0}
.family>summary .name{font-weight:650;font-size:11.4pt}.family>summary .name::first-letter{text-transform:uppercase}
.family .amount{font-weight:600;font-variant-numeric:tabular-nums}.family .count{margin-left:auto;font-size:8.8pt}
.laws td{vertical-align:top}.laws tr.top td{border-bottom:0;padding-bottom:0}.laws tbody{break-inside:avoid}
.laws th{white-space:nowrap}.laws td.no{color:var(--soft);width:20px}
.laws .where{color:var(--soft)}.laws td:nth-child(2){width:34%}
.laws .say{font-size:9pt}.laws td.n{white-space:nowrap;font-size:8.8pt}.laws .values{white-space:nowrap;font-size:9pt}
.glossary{display:grid;grid-template-columns:max-content 1fr;gap:2px 14px;margin:0}
.law{font-size:8.8pt;color:var(--soft);
font-family:"Cambria Math","STIX Two Math","Latin Modern Math",Cambria,"DejaVu Serif",serif;font-style:italic}
.meter{display:inline-block;width:36px;height:7px;background:var(--rule);border-radius:4px;vertical-align:1px;
margin-right:7px;overflow:hidden}.meter i{display:block;height:100%;background:var(--after)}
.alt{margin:3px 0 0;font-size:8.8pt;color:var(--warn)}
.grid2{display:grid;grid-template-columns:1fr 1fr;gap:8px 14px}.grid2>*{break-inside:avoid}
figure{margin:0;break-inside:avoid}figcaption{font-size:8.8pt;color:var(--soft)}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:9.4pt}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1px solid var(--ink);padding:3px 8px 3px 0}
td{border-bottom:1px solid var(--rule);padding:3px 8px 3px 0}tr{break-inside:avoid}dl{break-inside:avoid}
td.n,th.n{text-align:right}table.fit{width:auto;min-width:46%}
ul{margin:0 0 6px;padding-left:17px}li{margin-bottom:2px}
footer{margin-top:20px;border-top:1px solid var(--rule);padding-top:7px;font-size:8.6pt;color:var(--soft)}
code{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:8.6pt;overflow-wrap:anywhere}
.again{break-before:page;margin-top:26px}
@media screen{body{margin:8mm auto;box-shadow:0 1px 8px rgba(28,39,48,.18)}}
@media print{html{background:#fff}body{padding:0;max-width:none;margin:0}}
@page{size:A4;margin:15mm 16mm 16mm}
@media (max-width:640px){.grid2{grid-template-columns:minmax(0,1fr)}body{padding:16px;margin:0}
.glossary{grid-template-columns:minmax(0,1fr)}.glossary dt{font-weight:600;margin-top:4px}
table:not(.laws){display:block;overflow-x:auto}table:not(.laws) td:first-child{white-space:nowrap}
/* A wide picture keeps its size: its words could not be read else. */
section>figure{overflow-x:auto}section>figure>svg{min-width:600px}
/* A law is a card: what its column says stands before each value. */
.laws,.laws tbody,.laws tr,.laws td{display:block}.laws thead,.laws td:empty{display:none}
.laws tr.top{display:grid;grid-template-columns:20px minmax(0,1fr);padding-top:4px}
.laws tr.top td{grid-column:2;padding:1px 0;width:auto;text-align:left;white-space:normal}
.laws tr.top td.no{grid-column:1;grid-row:1}.laws tr.top br{display:none}
.laws td[data-head]::before{content:attr(data-head)": ";color:var(--soft)}
.laws tr:not(.top) td{padding-left:20px;width:auto}}
"""
    + PICTURES
)
