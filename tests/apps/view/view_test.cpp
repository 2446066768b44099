// `view` by the program itself: what is shown from which camera, that its command makes the same bits, and who may turn it.
#include <doctest/doctest.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/support/mesh_files.h"
#include "tests/support/served_page.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::view_test {

namespace {

std::vector<std::string> line_of(const std::string& scene, const std::vector<std::string>& options,
                                 std::vector<std::string> line) {
  line.insert(line.end(), {DMPC_PROGRAM, "view", scene, "--nodes=3", "--quiet"});
  line.insert(line.end(), options.begin(), options.end());
  return line;
}

/// A view of a scene, and somebody who looks at it.
struct Viewed {
  explicit Viewed(const std::string& scene, const std::vector<std::string>& options = {"--resolution=32x24"},
                  const std::vector<std::string>& begin = {})
      : page(line_of(scene, options, begin)), viewer(page.port) {
    viewer.get(page.path("events"), page.host);
  }

  /// The report of the next picture not yet reported.
  std::string picture() {
    const std::string begin = "event: picture\ndata: ";
    std::size_t at = std::string::npos;
    while ((at = viewer.heard().find(begin, heard)) == std::string::npos ||
           viewer.heard().find("\n\n", at) == std::string::npos) {
      REQUIRE(viewer.hear_more());
    }
    heard = viewer.heard().find("\n\n", at);
    return viewer.heard().substr(at + begin.size(), heard - at - begin.size());
  }
  /// The picture once the camera rests.
  std::string resting_picture() {
    std::string reported = picture();
    while (value(reported, "moving") != "false") {
      reported = picture();
    }
    return reported;
  }
  std::string wish(const std::string& camera, bool is_moving) const {
    return page.sent("camera", R"({"camera": ")" + camera + R"(", "moving": )" + (is_moving ? "true}" : "false}"));
  }
  /// Value of a key, without its quotes.
  static std::string value(const std::string& json, const std::string& key) {
    const std::size_t at = json.find('"' + key + "\":") + key.size() + 3;
    const bool is_text = json[at] == '"';
    return json.substr(at + (is_text ? 1 : 0), json.find_first_of(is_text ? "\"" : ",}", at + 1) - at - (is_text ? 1 : 0));
  }

  ServedPage page;
  WebClient viewer;
  std::size_t heard = 0;
};

/// Film of the picture that the reported command makes.
std::string film_by(const std::string& command) {
  const TemporaryFolder folder;
  const std::string shell = "cd " + folder.path().string() + " && " + DMPC_PROGRAM + command.substr(4) + " --stats=stats.json";
  const Said said = run({"sh", "-c", shell});
  REQUIRE_MESSAGE(said.status == 0, said.errors);
  const std::string stats = file_text(folder / "stats.json");
  const std::size_t at = stats.find("\"film_hash\": \"") + 14;
  return stats.substr(at, stats.find('"', at) - at);
}

}  // namespace

TEST_CASE("a view begins with the scene's own camera, roughly and then as it is, and a wish moves it") {
  Viewed viewed("balls-2");
  const std::string first = viewed.resting_picture();
  CHECK(Viewed::value(first, "width") == "32");
  CHECK(Viewed::value(first, "height") == "24");
  CHECK(contains(viewed.viewer.heard(), "\"height\":24,\"home\":\"" + Viewed::value(first, "camera")));
  CHECK(contains(viewed.viewer.heard(), "\"pivot\":\""));
  CHECK(contains(viewed.wish("3,2,2/0,0,0/0,0,1/40", true), "200 OK"));
  const std::string moving = viewed.picture();
  CHECK(Viewed::value(moving, "camera") == "3,2,2/0,0,0/0,0,1/40");
  CHECK(Viewed::value(moving, "width") == "16");
  CHECK(Viewed::value(moving, "height") == "12");
  CHECK(Viewed::value(moving, "command").empty());
  CHECK(contains(viewed.wish("3,2,2/0,0,0/0,0,1/40", false), "200 OK"));
  const std::string rests = viewed.resting_picture();
  CHECK(Viewed::value(rests, "camera") == "3,2,2/0,0,0/0,0,1/40");
  CHECK(Viewed::value(rests, "film") != Viewed::value(first, "film"));
}

TEST_CASE("the command that is shown makes the picture to the last bit, by every strategy, also after others were seen") {
  for (const std::string option : {"--strategy=svm", "--strategy=replicated", "--strategy=dataflow", "--strategy=forest",
                                   "--runner=pool", "--samples=auto", "--transport=paths"}) {
    CAPTURE(option);
    Viewed viewed("rings-1-t1", {"--resolution=24x24", option});
    const std::string own = viewed.resting_picture();
    CHECK(film_by(Viewed::value(own, "command")) == Viewed::value(own, "film"));
    viewed.wish("-3,7,5.123456789/1,0.5,0/0,0,1/33.3", true);
    viewed.picture();
    viewed.wish("-3,7,5.123456789/1,0.5,0/0,0,1/33.3", false);
    const std::string turned = viewed.resting_picture();
    CHECK(contains(Viewed::value(turned, "command"), "--camera=-3,7,5.123456789/1,0.5,0/0,0,1/33.3 --resolution=24x24"));
    CHECK(film_by(Viewed::value(turned, "command")) == Viewed::value(turned, "film"));
  }
}

TEST_CASE("from very far away, too, the command makes the picture to the last bit") {
  Viewed viewed("balls-2");
  viewed.resting_picture();
  viewed.wish("400,300,200/0,0,0/0,0,1/0.4", false);
  const std::string far = viewed.resting_picture();
  CHECK(film_by(Viewed::value(far, "command")) == Viewed::value(far, "film"));
}

TEST_CASE("a mesh with a camera of its own, and no light, is lit as the command lights it") {
  const TemporaryFolder folder;
  tests::Gltf gltf{.nodes = R"([{"mesh":0},{"camera":0,"translation":[1,0,2]}])", .roots = "[0,1]"};
  gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1}}])";
  write_text(folder / "a mesh.gltf", gltf.text());
  Viewed viewed((folder / "a mesh.gltf").string(), {"--resolution=16x16", "--transport=whitted", "--samples=4"});
  const std::string own = viewed.resting_picture();
  CHECK(film_by(Viewed::value(own, "command")) == Viewed::value(own, "film"));
  viewed.wish("2,1,3/0.5,0,0/0,1,0/45", false);
  const std::string turned = viewed.resting_picture();
  CHECK(film_by(Viewed::value(turned, "command")) == Viewed::value(turned, "film"));
}

TEST_CASE("a final wish ends the view, and its process renders the picture that was seen, and replaces no file") {
  const TemporaryFolder folder;
  write_text(folder / "view.png", "of another day");
  Viewed viewed("balls-2", {"--resolution=32x24"}, {"/usr/bin/env", "-C", folder.path().string()});
  viewed.resting_picture();
  viewed.wish("3,2,2/0,0,0/0,0,1/40", false);
  const std::string command = Viewed::value(viewed.resting_picture(), "command");
  const std::string final =
      command.substr(0, command.find("view.png")) + "view-2.png" + command.substr(command.find("view.png") + 8);
  CHECK(contains(viewed.page.sent("camera", R"({"camera": "3,2,2/0,0,0/0,0,1/40", "moving": false, "render": true})"), "200 OK"));
  CHECK(contains(viewed.viewer.heard_all(), "event: end\ndata: {\"figures\":\"" + final + "\""));
  CHECK(viewed.page.process.status() == 0);
  CHECK(contains(viewed.page.process.errors(), "dmpc: " + final + "\n"));
  CHECK(file_text(folder / "view.png") == "of another day");
  const TemporaryFolder other;
  const Said said = run({"sh", "-c", "cd " + other.path().string() + " && " + DMPC_PROGRAM + command.substr(4)});
  REQUIRE(said.status == 0);
  CHECK(file_text(folder / "view-2.png") == file_text(other / "view.png"));
}

TEST_CASE("of a picture that takes long nothing is waited for when the camera moves on") {
  Viewed viewed("balls-4", {"--resolution=1024x1024", "--samples=4096"});
  CHECK(Viewed::value(viewed.picture(), "moving") == "true");
  viewed.viewer.heard_until("Rendering the picture.");
  viewed.wish("3,2,2/0,0,0/0,0,1/40", true);
  CHECK(Viewed::value(viewed.picture(), "camera") == "3,2,2/0,0,0/0,0,1/40");
}

TEST_CASE("bad wishes are answered by a sentence, and what comes from elsewhere, or is too long, by nothing of ours") {
  Viewed viewed("balls-2");
  viewed.resting_picture();
  for (const std::string camera : {"nan,0,1/0,0,0/0,1,0/45", "1,2,3/1,2,3/0,1,0/45", "0,0,1/0,0,0/0,0,1/45", "x"}) {
    const std::string answer = viewed.wish(camera, false);
    CHECK(contains(answer, "400 Bad Request"));
    CHECK(contains(answer, "camera=" + camera + ": expected "));
  }
  CHECK(contains(viewed.page.sent("camera", std::string(4097, ' ')), "413 Payload Too Large"));
  CHECK(contains(viewed.page.sent("other", "{}"), "405 Method Not Allowed"));
  CHECK(contains(viewed.page.sent("camera", "{}", "Origin: http://evil.example\r\n"), "403 Forbidden"));
  CHECK(contains(viewed.page.sent("camera", "{}", "Sec-Fetch-Site: cross-site\r\n"), "403 Forbidden"));
  CHECK(contains(viewed.page.sent("camera", "{}", "Transfer-Encoding: chunked\r\n"), "415 Unsupported Media Type"));
  CHECK(contains(viewed.page.sent("camera", "{}", "Content-Encoding: gzip\r\n"), "400 Bad Request"));
  WebClient form(viewed.page.port);
  form.send("POST " + viewed.page.path("camera") + " HTTP/1.1\r\nHost: " + viewed.page.host +
            "\r\nContent-Type: text/plain\r\nContent-Length: 2\r\n\r\n{}");
  CHECK(contains(form.heard_all(), "415 Unsupported Media Type"));
  CHECK(contains(viewed.page.got("camera"), "404 Not Found"));
}

TEST_CASE("a signal ends it with status 130, and who looks on is told so") {
  Viewed viewed("balls-2");
  viewed.resting_picture();
  viewed.page.process.send(SIGINT);
  CHECK(contains(viewed.viewer.heard_all(),
                 "event: end\ndata: {\"figures\":\"\",\"page\":false,\"said\":\"dmpc was asked to stop.\"}"));
  CHECK(viewed.page.process.status() == 130);
  CHECK(contains(viewed.page.process.errors(), "interrupted, the page receives no further updates"));
}

TEST_CASE("what the camera would take along, and what there is none of, is refused before anything is read") {
  for (const auto& [option, said] :
       std::vector<std::pair<std::string, std::string>>{{"--fill=0.3", "--fill does not go with view"},
                                                        {"--light-radius=0.1", "--light-radius does not go with view"},
                                                        {"--pool-threads=2", "--pool-threads does not go with --runner=threads"},
                                                        {"--runner=mpi", "--runner"},
                                                        {"--frames=3", "--frames"},
                                                        {"--report=a.html", "--report"},
                                                        {"--port=65536", "--port"}}) {
    const Said refused = run({DMPC_PROGRAM, "view", "none.nff", "--transport=paths", option});
    CHECK(refused.status == 2);
    CHECK_MESSAGE(contains(refused.errors, said), refused.errors);
  }
  const Said large = run({DMPC_PROGRAM, "view", "balls-2", "--resolution=4096x4096"});
  CHECK(large.status == 1);
  CHECK(contains(large.errors, "a picture of 4096x4096 is too large for view: expected at most 4,194,304 pixels"));
}

}  // namespace dmpc::tests::view_test
