"""Style of the report: light, dark, and print."""

STYLE = """
:root{--a:#0b62b8;--b:#c4501b;--c:#2f7d32;--good:#1d6b2a;--fair:#8a5a00;--bad:#b3261e;--rule:#bbb;
 color-scheme:light dark;background:#fff;color:#1b1b1b}
@media screen and (prefers-color-scheme:dark){:root{--a:#6fb4ff;--b:#ff9d6b;--c:#86d18a;--good:#86d18a;--fair:#f0c060;
 --bad:#ff8a80;--rule:#555;background:#161616;color:#e8e8e8}a{color:#8ab8ff}}
body{margin:0;font:15px/1.45 system-ui,sans-serif}
main{max-width:72rem;margin:0 auto;padding:1rem}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin:1.6rem 0 .4rem}h3{font-size:1rem;margin:.3rem 0}
p{margin:.35rem 0;max-width:60rem}
table{border-collapse:collapse;margin:.4rem 0}
th,td{padding:.15rem .6rem;border-bottom:1px solid var(--rule);text-align:left;vertical-align:top}
thead th{border-bottom:2px solid var(--rule)}
.measured{font-size:.87rem}.measured th{font-weight:400}.measured td:nth-child(2){font-variant-numeric:tabular-nums}
section{border-top:1px solid var(--rule)}
.variants{display:flex;flex-wrap:wrap;gap:1.5rem}.variant{flex:1 1 20rem;min-width:0;max-width:32rem}
.pass{color:var(--good)}.deviation{color:var(--fair)}.fail{color:var(--bad);font-weight:600}
svg{width:100%;max-width:26rem;height:auto;display:block}
svg text{fill:currentColor;font:10px system-ui,sans-serif}svg rect{shape-rendering:crispEdges}
@media print{body{font-size:10pt}section,.variant,tr{break-inside:avoid}a{color:inherit;text-decoration:none}
 svg{max-width:8.5cm}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
"""
