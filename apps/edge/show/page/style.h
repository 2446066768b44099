// How a page looks: light or dark as the reader has it, in one column on a telephone.
#pragma once

namespace dmpc::apps::html {

inline constexpr const char* style =
    R"(:root{color-scheme:light dark;--ink:#1a1a1a;--faint:#5c5c5c;--paper:#fff;--card:#f5f6f8;--line:#d9dce1;--link:#0b57a4;--shade:#0003}
@media(prefers-color-scheme:dark){:root{--ink:#e4e4e4;--faint:#a5a9b0;--paper:#15171a;--card:#1e2125;--line:#383d44;--link:#7db7f0;--shade:#fff3}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.45 system-ui,sans-serif}
main{max-width:1200px;margin:0 auto;padding:16px}
h1{font-size:1.5rem;line-height:1.2;margin:.2em 0 .6em;overflow-wrap:anywhere}
h2{font-size:1.2rem;margin:2em 0 .6em;padding-top:.5em;border-top:1px solid var(--line)}
p{max-width:46em;margin:.5em 0}
a{color:var(--link)}
nav{display:flex;flex-wrap:wrap;gap:4px 16px;margin:.8em 0}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,300px),1fr));gap:8px;margin:1em 0}
dl div{background:var(--card);border-radius:6px;padding:8px 10px}
dt{color:var(--faint);font-size:.85rem}
dd{margin:0;overflow-wrap:anywhere}
figure{display:inline-block;vertical-align:top;margin:0 10px 16px 0;max-width:100%}
figcaption{color:var(--faint);font-size:.85rem;max-width:570px;margin-top:4px}
img{display:block;max-width:100%;height:auto}
img.picture{background:#fff}
img.plot{background:var(--card);border-radius:6px;width:570px}
.conclusion{font-size:1.05rem;border-left:3px solid var(--link);padding-left:10px}
pre,code{font-family:ui-monospace,monospace;font-size:.88rem}
pre.copy{background:var(--card);border-radius:6px;padding:8px 10px;margin:.5em 0;white-space:pre-wrap;overflow-wrap:anywhere;user-select:all}
.saves{margin:.2em 0 1em}
.save{font-size:.8rem;border:1px solid var(--line);border-radius:4px;padding:0 6px;text-decoration:none}
.save::before{content:"\2193  "}
.scroll{overflow-x:auto;margin:.8em 0;background:linear-gradient(90deg,var(--paper) 30%,#0000) 0 0/40px 100%,linear-gradient(270deg,var(--paper) 30%,#0000) 100% 0/40px 100%,linear-gradient(90deg,var(--shade),#0000) 0 0/14px 100%,linear-gradient(270deg,var(--shade),#0000) 100% 0/14px 100%;background-repeat:no-repeat;background-attachment:local,local,scroll,scroll}
table{border-collapse:collapse;min-width:280px;font-size:.85rem;font-variant-numeric:tabular-nums}
caption{text-align:left;font-weight:600;padding:0 0 4px}
th,td{padding:3px 9px;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}
th{color:var(--faint);font-weight:600;vertical-align:bottom;white-space:normal}
.text{text-align:left}
.dense{font-size:.76rem}
.dense th,.dense td{padding:3px 5px}
details{margin:.8em 0}
summary{cursor:pointer;font-weight:600;font-size:.9rem}
.notes{color:var(--faint);font-size:.85rem;padding-left:1.2em;max-width:54em}
.glossary dt{color:var(--ink);font-weight:600}
.glossary dd{font-size:.9rem}
@media print{:root{color-scheme:light;--ink:#000;--faint:#444;--paper:#fff;--card:#fff;--line:#bbb;--link:#000}
body{font-size:10pt}main{max-width:none;padding:0}nav,.save{display:none}
figure,tr,dl div,pre{break-inside:avoid}h2,caption,.conclusion{break-after:avoid}thead{display:table-header-group}
img.plot{width:8.2cm}.scroll{overflow:visible;background:none}table,.dense{font-size:7.5pt}th,td,.dense th,.dense td{padding:1px 4px}
}
)";

}  // namespace dmpc::apps::html
