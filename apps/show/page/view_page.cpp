#include "apps/show/page/view_page.h"

#include <array>

#include "apps/edge/show/page/escaped.h"

namespace dmpc::apps::html {

namespace {

constexpr const char* view_body =
    R"(<p id="said" role="status">This page lives by its script, which does not run here.</p>
<progress id="done" aria-label="Pixels done" value="0" max="1"></progress>
<canvas id="shot" tabindex="0" role="application" aria-label="The picture. Arrow keys go round it, with Shift they shift it, plus and
minus go nearer and farther, Home goes back." width="1" height="1"></canvas>
<div id="ways" role="group" aria-label="Where the camera goes"><button type="button" id="left">Left</button>
<button type="button" id="right">Right</button> <button type="button" id="up">Up</button>
<button type="button" id="down">Down</button> <button type="button" id="nearer">Nearer</button>
<button type="button" id="farther">Farther</button> <button type="button" id="home">Back to the start</button></div>
<p>Drag to go round, with Shift or the right button to shift, turn the wheel to go nearer. Or by keys, once the picture is chosen:
arrows, Shift with arrows, + and -, Home.</p>
<dl id="facts"></dl>
<p>This command makes the picture of a camera that rests, to the last bit:</p>
<pre id="command" class="copy"></pre>
)";

}  // namespace

std::string view_page(const std::string& title) {
  const std::string name = escaped(title);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
         name + "</title><link rel=\"icon\" href=\"data:,\"><style>" + page_style.text + "</style><style>" + view_style.text +
         "</style></head><body><main><h1>" + name + "</h1>\n" + view_body + "</main><script>" + view_script.text +
         "</script></body></html>\n";
}

std::string view_policy() {
  const std::array styles = {page_style, view_style};
  const std::array scripts = {view_script};
  return policy_of(styles, scripts) + "; connect-src 'self'; frame-ancestors 'none'";
}

}  // namespace dmpc::apps::html
