// Scenes for programs of one's own, held against the reference renderer.
#include <doctest/doctest.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "apps/computer/dmpc/scene.h"
#include "apps/frontend/line/number_text.h"
#include "core/families/scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests::computer_scene_test {

namespace {

constexpr std::uint32_t side = 24;

/// All pages are here.
class WholeScene final : public Pages {
 public:
  explicit WholeScene(const Scene& scene) : scene_(scene), charged_(scene_operation_count) {}

  const std::byte* find(std::uint64_t offset) override { return &scene_.records()[offset]; }
  void charge(Index operation, std::uint64_t count) override { charged_.at(operation) += count; }
  const std::vector<std::uint64_t>& charged() const { return charged_; }

 private:
  const Scene& scene_;
  std::vector<std::uint64_t> charged_;
};

/// One page is here, that which has been fetched last.
class OnePage final : public Pages {
 public:
  explicit OnePage(const Scene& scene) : scene_(scene), bytes_(scene.page_bytes() + overread_bytes) {}

  const std::byte* find(std::uint64_t offset) override {
    wanted_ = offset / scene_.page_bytes();
    return wanted_ == here_ ? &bytes_[offset % scene_.page_bytes()] : nullptr;
  }
  void charge(Index, std::uint64_t) override {}
  void fetch() {
    REQUIRE(wanted_ != here_);
    here_ = wanted_;
    std::memcpy(bytes_.data(), &scene_.records()[*here_ * scene_.page_bytes()], scene_.page_bytes());
    ++fetched_;
  }
  std::uint64_t fetched() const { return fetched_; }

 private:
  const Scene& scene_;
  std::vector<std::byte> bytes_;
  std::optional<std::uint64_t> here_, wanted_;
  std::uint64_t fetched_ = 0;
};

/// The film's hash; `fetch` is called for what is absent.
template <class Fetch>
std::string hash_of(const Scene& scene, Pages& pages, const Fetch& fetch) {
  Picture picture(scene);
  PixelTask task(scene);
  for (std::uint32_t pixel = 0; pixel < scene.pixel_count(); ++pixel) {
    task.start(pixel);
    for (Step step = Step::more; step != Step::finished;) {
      step = task.run(pages);
      if (step == Step::absent) {
        fetch();
      }
    }
    picture.put(pixel, task.light());
  }
  return picture.hash();
}

const std::vector<std::string> scene_names = {"rings-1-t1", "balls-1", "teapot-4", "tree-2"};

}  // namespace

TEST_CASE("pixels of a program's own have the bits of the reference renderer, with all pages or with one at a time") {
  for (const std::string& name : scene_names) {
    INFO(name);
    const Subject subject(core::built_in_scene(core::parse_scene_name(name)), {.width = side, .height = side});
    const std::string expected = apps::hash_text(subject.outcome().film_hash);
    for (const std::size_t page_bytes : {std::size_t{512}, std::size_t{4096}}) {
      const Scene scene(name, side, side, page_bytes);
      WholeScene whole(scene);
      CHECK(hash_of(scene, whole, [] { FAIL("all pages are here"); }) == expected);
      OnePage one(scene);
      CHECK(hash_of(scene, one, [&] { one.fetch(); }) == expected);
      CHECK(one.fetched() >= scene.page_count() / 8);
    }
  }
}

TEST_CASE("what pixels do is charged: rays, walk, tests and shading, each once") {
  const Scene rings("rings-1-t1", side, side);
  WholeScene pages(rings);
  hash_of(rings, pages, [] {});
  const Subject subject(core::built_in_scene(core::parse_scene_name("rings-1-t1")), {.width = side, .height = side});
  const std::vector<OperationNeed> operations = scene_operations();
  REQUIRE(operations.size() == scene_operation_count);
  CHECK(operations[0].name == "ray_setup");
  CHECK(operations[6].name == "shading");
  CHECK(pages.charged()[6] == subject.outcome().shadings);
  for (const Index operation : {0, 1, 2, 3}) {
    CHECK(pages.charged()[operation] > 0);
    CHECK(operations[operation].nanoseconds > 0);
  }
  CHECK(pages.charged()[4] == 0);  // no spheres
}

TEST_CASE("a scene that there is not, and pages and pictures that cannot be, are refused") {
  CHECK_THROWS_AS(Scene("castle-3", side, side), UsageError);
  CHECK_THROWS_AS(Scene("rings-3", 0, side), UsageError);
  CHECK_THROWS_AS(Scene("rings-3", side, 65537), UsageError);
  CHECK_THROWS_AS(Scene("rings-1-t1", side, side, 700), UsageError);
}

}  // namespace dmpc::tests::computer_scene_test
