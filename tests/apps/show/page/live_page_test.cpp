// The live page in a browser; a window around it sends its script the server's events.
#include "apps/show/page/live_page.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/browser.h"

namespace dmpc::tests::live_page_test {

namespace {

namespace html = apps::html;

/// Two nodes, a picture of 4x2 pixels: a red pixel comes; in the fourth step node 0 traces all the time and node 1 does nothing.
/// Events of another frame, or from before steps became longer, are sent, too, and must be ignored.
constexpr const char* telling = R"(<script>addEventListener('load',()=>{
const page=document.querySelector('iframe').contentWindow,tell=(name,event)=>page.eval(`${name}(${JSON.stringify(event)})`);
const text=(id)=>page.document.getElementById(id).textContent;
const pixel=(id,x,y)=>[...page.document.getElementById(id).getContext('2d').getImageData(x,y,1,1).data].join();
tell('begin',{width:4,height:2,nodes:2,modelled:true,frame:2,works:['tracing','shading','paging','packing','messages','control'],
levels:40,steps:240});
tell('drawTile',{x:1,y:0,width:1,height:1,rgb:'/wAA'});
tell('drawStep',{frame:2,doublings:0,step:7,ms:2000,cells:'8PA='});
tell('drawStep',{frame:2,doublings:1,step:3,ms:2000,cells:'8AE='});
tell('drawStep',{frame:1,doublings:1,step:5,ms:9000,cells:'8PA='});
tell('drawStep',{frame:2,doublings:0,step:6,ms:9000,cells:'8PA='});
tell('reportState',{said:'It comes.',ms:1500,ns:2000000,done:3,total:8,pass:1,packets:7,bytes:5120000,shares:[0.5,0,0,0,0,0]});
document.title=`${text('said')} shot ${pixel('shot',1,0)} ${pixel('shot',0,0)} steps ${[3,5,6,7].map(x=>pixel('raster',x,0))} idle `+
`${pixel('raster',3,200)} until ${text('until')} facts ${text('facts')} shares ${text('shares')} wide `+
`${page.document.documentElement.scrollWidth} of ${page.innerWidth}`})</script>)";

/// A picture of 2x1 pixels, the left one red, in place of 4x2; then the button to the left, and what is sent for it: at once that
/// the camera moves, and once it rests that it does.
constexpr const char* looking_round = R"(<script>addEventListener('load',()=>{
const page=document.querySelector('iframe').contentWindow,tell=(name,event)=>page.eval(`${name}(${JSON.stringify(event)})`);
const element=(id)=>page.document.getElementById(id),shown=(id)=>element(id).getClientRects().length>0,sent=[];
page.fetch=async(place,{body})=>{sent.push(`${place} ${body}`);return{ok:true}};
tell('begin',{width:4,height:2,nodes:0,works:[],levels:40,steps:0,home:'4,0,0/1,0,0/0,0,1/45',pivot:'0,0,0'});
tell('drawShot',{x:0,y:0,width:2,height:1,rgb:'/wAAAAAA',camera:'4,0,0/1,0,0/0,0,1/45',moving:false,ms:7,film:'f',command:'dmpc'});
const pixel=[...element('shot').getContext('2d').getImageData(0,1,1,1).data].join();
element('right').click();
setTimeout(()=>{document.title=`${element('shot').getAttribute('role')} pixel ${pixel} figures ${element('figures').textContent} facts `+
`${element('facts').textContent} stop ${shown('stop')} nodes ${shown('nodes')} moves ${shown('moves')} sent ${sent.join(' then ')} wide `+
`${page.document.documentElement.scrollWidth} of ${page.innerWidth}`},1000)})</script>)";

}  // namespace

TEST_CASE("in a browser who looks round sees pictures of any size, and moves the camera, which rests where it was left") {
  const TemporaryFolder folder;
  for (const int width : {400, 1280}) {
    const std::string reported = reported_by_browser(html::live_page("dmpc view x", html::LiveKind::view).html, width,
                                                     width == 400, folder / "shot.png", looking_round);
    const std::string camera = "\"3.984779,0.348623,0/0,0,0/0,0,1/45\"", wide = std::to_string(width);
    CHECK(reported ==
          "application pixel 255,0,0,255 figures dmpc facts Picture2x1Time7 msCamera4,0,0/1,0,0/0,0,1/45Filmf stop false "
          "nodes false moves true sent camera {\"camera\":" +
              camera + ",\"moving\":true} then camera {\"camera\":" + camera + ",\"moving\":false} wide " + wide + " of " + wide);
  }
}

TEST_CASE("in a browser the live page shows tiles, steps and figures as it is told them, on a telephone and a screen" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  for (const int width : {400, 1280}) {
    const std::string reported = reported_by_browser(html::live_page("dmpc render x", html::LiveKind::run).html, width,
                                                     width == 400, folder / "shot.png", telling);
    const std::string wide = std::to_string(width);
    CHECK(reported ==
          "It comes. shot 255,0,0,255 0,0,0,0 steps 0,114,178,255,0,0,0,0,0,0,0,0,0,0,0,0 idle 0,0,0,0 until 120 s facts "
          "Time by the wall clock1.5 sPixels done3 of 8Virtual time2 msPackets sent7Bytes sent5.1 MB shares "
          "tracing50.0 %shading0.0 %paging0.0 %packing0.0 %messages0.0 %control0.0 % wide " +
              wide + " of " + wide);
  }
}

TEST_CASE("the live page's policy runs what it has in itself alone, and lets it ask its server alone") {
  const auto [page, policy] = html::live_page("x", html::LiveKind::view);
  CHECK(policy.starts_with("default-src 'none'; img-src data:; script-src 'sha256-"));
  CHECK(policy.ends_with("'; base-uri 'none'; form-action 'none'; connect-src 'self'; frame-ancestors 'none'"));
  CHECK(count(policy, "'sha256-") == count(page, "<style>") + count(page, "<script>"));
  CHECK_FALSE(contains(policy, "unsafe"));
  CHECK_FALSE(contains(page, " style="));
  CHECK(contains(html::live_page("</script><b>", html::LiveKind::run).html, "&lt;/script&gt;&lt;b&gt;"));
}

}  // namespace dmpc::tests::live_page_test
