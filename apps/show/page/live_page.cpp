#include "apps/show/page/live_page.h"

#include <array>

#include "apps/frontend/show/page/escaped.h"

namespace dmpc::apps::html {

namespace {

/// Elements for both kinds of page; the style hides those for the other kind.
constexpr const char* body =
    R"(<p id="said" role="status">This page lives by its script, which does not run here.</p>
<progress id="done" aria-label="Pixels done" value="0" max="1"></progress>
<p id="ways" class="for-run"><button type="button" id="stop">Stop the run, as Ctrl-C does</button></p>
<div id="live"><section><h2 class="for-run">The picture as it comes</h2>
<canvas id="shot" role="img" aria-label="The picture as it comes" width="1" height="1"></canvas>
<div class="for-view"><div id="moves" role="group" aria-label="Where the camera goes"><button type="button" id="left">Left</button>
<button type="button" id="right">Right</button> <button type="button" id="up">Up</button>
<button type="button" id="down">Down</button> <button type="button" id="nearer">Nearer</button>
<button type="button" id="farther">Farther</button> <button type="button" id="home">Back to the start</button>
<button type="button" id="render">Render</button></div>
<p>Drag to go round, with Shift or the right button to shift, turn the wheel to go nearer. Or by keys, once the picture is chosen:
arrows, Shift with arrows, + and -, Home. Render, or the key R, ends the view: dmpc then renders this
picture as view.png, or view-2.png and so on.</p></div></section>
<section><div id="nodes" class="for-run"><h2>What each node does, a row a node</h2>
<canvas id="raster" role="img" aria-label="What each node did over time, a row a node. Below is what all of them do now." width="1"
height="1"></canvas>
<p id="axis"><span>0 s</span><span>by the wall clock</span><span id="until"></span></p>
<h2 id="when">What all of them do now, in parts of their time</h2>
<ul id="shares"></ul></div>
<p id="unseen" class="for-run" hidden>What each node does is shown on modelled machines (--runner=virtual) and with --report; to look on
at threads takes a third of their time.</p>
<dl id="facts"></dl></section></div>
<p class="for-view">This command makes the picture of a camera that rests, to the last bit:</p>
<pre id="figures" class="copy" hidden></pre>
)";

}  // namespace

PageServer::Page live_page(const std::string& title, LiveKind kind) {
  const std::string name = escaped(title);
  const std::array styles = {page_style, live_style};
  const std::array scripts = {live_script};
  return {
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
          name + "</title><link rel=\"icon\" href=\"data:,\"><style>" + page_style.text + "</style><style>" + live_style.text +
          "</style></head><body><main class=\"" + (kind == LiveKind::run ? "run" : "view") + "\"><h1>" + name + "</h1>\n" + body +
          "</main><script>" + live_script.text + "</script></body></html>\n",
      policy_of(styles, scripts) + "; connect-src 'self'; frame-ancestors 'none'"};
}

}  // namespace dmpc::apps::html
