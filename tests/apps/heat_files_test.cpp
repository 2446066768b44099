#include "apps/heat_files.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/heat_field.h"
#include "apps/image_file.h"
#include "core/expect.h"
#include "tests/apps/rendered.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps {

using nodes::HeatKind;
using tests::TemporaryFolder;

namespace {

RenderOptions with(const std::vector<HeatRequest>& requests, RenderOptions options = small()) {
  options.heat_maps = requests;
  return options;
}

}  // namespace

TEST_CASE("numbers are read back from the EXR file as they were counted") {
  const TemporaryFolder folder;
  const Rendered rendered(with({{HeatKind::references, folder / "a.exr"}, {HeatKind::references, folder / "a.png"}}));
  HeatFiles(rendered.record()).commit();
  const Image image = read_image(folder / "a.exr");
  const HeatField field = heat_field(HeatKind::references, rendered.record());
  CHECK(image.width == 16);
  for (std::size_t pixel = 0; pixel < field.values.size(); ++pixel) {
    CHECK(image.rgb[3 * pixel] == static_cast<float>(field.values[pixel]));
  }
  const std::string bytes = tests::file_text(folder / "a.exr");
  for (const char* const remark : {"references", "look-ups of pages", "balls-1", "svm", "threads"}) {
    CHECK_MESSAGE(contains(bytes, remark), remark);
  }
  CHECK(read_image(folder / "a.png").height > 12);
}

TEST_CASE("repeatable heat maps are the same files again, byte for byte") {
  const TemporaryFolder folder;
  const std::vector<HeatRequest> requests = {{HeatKind::time, folder / "a.exr"}, {HeatKind::faults, folder / "a.png"}};
  std::vector<std::string> texts;
  for (int run = 0; run < 2; ++run) {
    HeatFiles(Rendered(with(requests, modelled())).record()).commit();
    texts.push_back(tests::file_text(folder / "a.exr") + tests::file_text(folder / "a.png"));
  }
  CHECK(texts[0] == texts[1]);
}

TEST_CASE("files that are not committed leave nothing behind, nor do those that cannot all be written") {
  const TemporaryFolder folder;
  const Rendered rendered(with({{HeatKind::rays, folder / "a.exr"}, {HeatKind::rays, folder / "b.png"}}));
  {
    const HeatFiles files(rendered.record());
    CHECK(folder.entry_count() == 2);
  }
  CHECK(folder.entry_count() == 0);
  const Rendered wrong(with({{HeatKind::rays, folder / "a.exr"}, {HeatKind::rays, folder / "none/b.png"}}));
  CHECK_THROWS_AS(HeatFiles(wrong.record()), core::InputError);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("without requests there are no files") {
  const Rendered rendered(small());
  HeatFiles(rendered.record()).commit();
  CHECK(contains(rendered.json(), "\"heat_maps\": null"));
}

TEST_CASE("the counters list the heat maps") {
  const Rendered rendered(with({{HeatKind::rays, "r.png"}, {HeatKind::time, "t.exr"}}));
  const std::string json = rendered.json();
  CHECK(contains(json, "\"file\": \"r.png\""));
  CHECK(contains(json, "\"clock\": \"processor time\""));
  CHECK(value(json, "repeatable") == "true");
}

}  // namespace dmpc::apps
