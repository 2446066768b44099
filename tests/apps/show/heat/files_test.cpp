#include "apps/show/heat/picture.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "apps/show/heat/field.h"
#include "core/picture/heat_kind.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::heat_files_test {

using core::HeatKind;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

RenderOptions with(const std::vector<HeatRequest>& requests, RenderOptions options = small()) {
  options.heat_maps = requests;
  return options;
}

}  // namespace

TEST_CASE("numbers are read back from the EXR file as they were counted") {
  const TemporaryFolder folder;
  const Rendered rendered(with({{HeatKind::references, folder / "a.exr"}, {HeatKind::references, folder / "a.png"}}));
  write_text(folder / "a.exr", heat_file({HeatKind::references, "a.exr"}, rendered.record()));
  write_text(folder / "a.png", heat_file({HeatKind::references, "a.png"}, rendered.record()));
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
  const std::vector<HeatRequest> requests = {{HeatKind::time, "a.exr"}, {HeatKind::faults, "a.png"}};
  std::vector<std::string> texts;
  for (int run = 0; run < 2; ++run) {
    const Rendered rendered(with(requests, modelled()));
    texts.push_back(heat_file(requests[0], rendered.record()) + heat_file(requests[1], rendered.record()));
  }
  CHECK(texts[0] == texts[1]);
}

TEST_CASE("the counters list the heat maps") {
  const Rendered rendered(with({{HeatKind::rays, "r.png"}, {HeatKind::time, "t.exr"}}));
  const std::string json = rendered.json();
  CHECK(contains(json, "\"file\": \"r.png\""));
  CHECK(contains(json, "\"clock\": \"processor time\""));
  CHECK(value(json, "repeatable") == "true");
}

}  // namespace dmpc::apps::heat_files_test
