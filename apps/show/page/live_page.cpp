#include "apps/show/page/live_page.h"

#include <array>

#include "apps/edge/show/page/escaped.h"

namespace dmpc::apps::html {

namespace {

constexpr const char* body =
    R"(<p id="said" role="status">This page lives by its script, which does not run here.</p>
<progress id="done" aria-label="Pixels done" value="0" max="1"></progress>
<p id="ways"><button type="button" id="stop">Stop the run, as Ctrl-C does</button></p>
<div id="live"><section><h2>The picture as it comes</h2>
<canvas id="shot" role="img" aria-label="The picture as it comes" width="1" height="1"></canvas></section>
<section><div id="nodes"><h2>What each node does, a row a node</h2>
<canvas id="raster" role="img" aria-label="What each node did over time, a row a node. Below is what all of them do now." width="1"
height="1"></canvas>
<p id="axis"><span>0 s</span><span>by the wall clock</span><span id="until"></span></p>
<h2 id="when">What all of them do now, in parts of their time</h2>
<ul id="shares"></ul></div>
<p id="unseen" hidden>What each node does is shown on modelled machines (--runner=virtual) and with --report; to look on at threads takes
a third of their time.</p>
<dl id="facts"></dl></section></div>
<pre id="figures" class="copy" hidden></pre>
)";

}  // namespace

std::string live_page(const std::string& title) {
  const std::string name = escaped(title);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
         name + "</title><link rel=\"icon\" href=\"data:,\"><style>" + page_style.text + "</style><style>" + live_style.text +
         "</style></head><body><main><h1>" + name + "</h1>\n" + body + "</main><script>" + live_script.text +
         "</script></body></html>\n";
}

std::string live_policy() {
  const std::array styles = {page_style, live_style};
  const std::array scripts = {live_script};
  return policy_of(styles, scripts) + "; connect-src 'self'; frame-ancestors 'none'";
}

}  // namespace dmpc::apps::html
