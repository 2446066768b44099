// A page that plays, in a real browser: what its script draws when something is done there.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "tests/support/browser.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Prefix of the title if the player was not ready in time.
inline constexpr std::string_view not_there = "no player yet: ";

/// Writes the value of `expression`, in which `p` is the page, into the window's title, once the page's player is ready or after
/// `tenths` tenths of a second. `act` runs before.
inline std::string acting_script(const std::string& act, const std::string& expression, int tenths) {
  return "<script>addEventListener('load',()=>{const frame=document.querySelector('iframe'),p=frame.contentDocument,"
         "w=frame.contentWindow,id=(name)=>p.getElementById(name),key=(target,key)=>target.dispatchEvent(new "
         "w.KeyboardEvent('keydown',"
         "{key,bubbles:true,cancelable:true})),lit=(name='shot')=>{const "
         "c=id(name),d=c.getContext('2d').getImageData(0,0,c.width,c.height)"
         ".data;let n=0;for(let i=0;i<d.length;i+=4)n+=!(d[i]===26&&d[i+1]===26&&d[i+2]===26);return n};"
         // The browser's virtual clock runs on without frames, for which the page would wait, and while pictures are decoded.
         "const begin=(tries)=>{if(tries>0&&!p.documentElement.dataset.loaded){setTimeout(()=>begin(tries-1),100);return}"
         "w.requestAnimationFrame=(f)=>w.setTimeout(()=>f(w.performance.now()),16);" +
         act + ";setTimeout(()=>{document.title=(p.documentElement.dataset.loaded?'':'" + std::string(not_there) + "')+String(" +
         expression + ")},500)};begin(" + std::to_string(tenths) + ")})</script>";
}

/// Value of `expression` in the page; in a page without a player, at the end. On a busy computer the browser's clock runs ahead
/// of its work: then it is asked again, and given more time.
inline std::string reported(const std::string& page, const std::string& act, const std::string& expression,
                            const std::string& state = "") {
  const TemporaryFolder folder;
  std::string said;
  for (const int tenths : {30, 300, 3000}) {
    said = reported_by_browser(page, 1280, false, folder / "shot.png", acting_script(act, expression, tenths), state,
                               std::chrono::milliseconds(100 * tenths + 2000));
    if (!said.empty() && !said.starts_with(not_there)) {
      return said;
    }
  }
  return said.substr(said.starts_with(not_there) ? not_there.size() : 0);
}

/// Violations of the rules that tests/pages checks by other tools: duplicate ids, elements without the text or role that screen
/// readers need, controls without a label, targets smaller than 24 pixels, headings that skip a level.
inline constexpr const char* broken_rules =
    "(()=>{const "
    "ids=[...p.querySelectorAll('[id]')].map(e=>e.id),levels=[...p.querySelectorAll('h1,h2,h3')].map(e=>+e.tagName[1]);"
    "return [ids.length-new Set(ids).size,"
    "p.querySelectorAll('canvas:not([role=img][aria-label]),img:not([alt]),a[download]:not([href]),"
    "section:not([aria-label],[aria-labelledby]),ol[role],ul[role],div[aria-label]:not([role])').length,"
    "[...p.querySelectorAll('input,select')].filter(e=>!e.labels.length).length,"
    "[...p.querySelectorAll('#player button')].filter(e=>e.offsetHeight>0&&e.offsetHeight<24).length,"
    "levels.filter((level,i)=>i>0&&level>levels[i-1]+1).length].join()})()";

}  // namespace dmpc::tests
