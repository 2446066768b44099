#include "apps/formats/nff_reader.h"

#include <doctest/doctest.h>
#include <malloc.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "apps/formats/nff_tokens.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace nff_reader_test {

using namespace dmpc;
using apps::read_nff;

namespace {

const char* const refusals = "apps/formats/nff_refusals.txt";
const std::string view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 64 48\n";  // 7 lines

core::Scene read_text(const std::string& text) {
  std::istringstream input(text);
  return read_nff(input, "a.nff");
}

/// The message of the error that `text` must cause; empty if it causes none.
std::string message_of(const std::string& text) {
  return tests::complaint_of([&] { read_text(text); });
}

/// What stands on the line after a complete view is wrong: the message names line 8 and says `part`.
void check_refused(const std::string& line, const std::string& part, const std::string& where = "a.nff:8: ") {
  const std::string message = message_of(view + line);
  CAPTURE(line);
  CAPTURE(message);
  CHECK(message.starts_with(where));
  CHECK(message.find(part) != std::string::npos);
  CHECK(message.find("expected") != std::string::npos);
}

/// A view with one part replaced.
std::string view_with(const std::string& part, const std::string& line) {
  std::string text = view;
  const std::size_t start = text.find(part);
  return text.replace(start, text.find('\n', start) - start, line);
}

}  // namespace

TEST_CASE("a file of one view is a scene without objects and lights, on black") {
  const core::Scene scene = read_text(view);
  CHECK(scene.objects.empty());
  CHECK(scene.lights.empty());
  CHECK(scene.background == core::Vec3d{0, 0, 0});
  CHECK(scene.name == "a.nff");
}

TEST_CASE("the view is read part for part, in any order") {
  const core::Scene scene = read_text("v resolution 64 48 hither 0.5 up 0 1 0.25\nangle 30 from 1 2 3 at 4 5 6");
  CHECK(scene.view.from == core::Vec3d{1, 2, 3});
  CHECK(scene.view.at == core::Vec3d{4, 5, 6});
  CHECK(scene.view.up == core::Vec3d{0, 1, 0.25});
  CHECK(scene.view.angle_degrees == 30);
  CHECK(scene.view.hither == 0.5);
  CHECK(scene.view.width == 64);
  CHECK(scene.view.height == 48);
}

TEST_CASE("every kind of entity is read") {
  const core::Scene scene =
      read_text("b 0.1 0.2 0.3\n" + view +
                "l 1 2 3\nl 4 5 6 0.5 0.6 0.7\nf 1 0.5 0.25 0.8 0.1 3.5 0.2 1.5\ns 1 2 3 4\nc 0 0 0 2 0 0 1 1\n"
                "p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\npp 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 3\n");
  CHECK(scene.background == core::Vec3d{0.1, 0.2, 0.3});
  REQUIRE(scene.lights.size() == 2);
  CHECK_FALSE(scene.lights[0].has_color);
  CHECK(scene.lights[1].has_color);
  CHECK(scene.lights[1].color == core::Vec3d{0.5, 0.6, 0.7});
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0] == core::Material{{1, 0.5, 0.25}, 0.8, 0.1, 3.5, 0.2, 1.5});
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.objects[0].kind == core::ObjectKind::sphere);
  CHECK(scene.objects[1].kind == core::ObjectKind::cone);
  CHECK(scene.objects[2].vertex_count == 4);
  CHECK(scene.objects[3].kind == core::ObjectKind::patch);
  CHECK(scene.normals[2] == core::Vec3d{0, 0, 3});
  CHECK(scene.cones[0].apex_radius == 1);
}

TEST_CASE("layout is free: tokens on any line, tabs, carriage returns, comments, an end without a line end") {
  const core::Scene scene =
      read_text("# a comment\r\n\r\n" + view + "s 1 2 # centre\r\n 3\t4 s\n0 0\n0 1#last\nl 1 2 3 # 9 9 9\ns 0 0 0 7");
  REQUIRE(scene.spheres.size() == 3);
  CHECK(scene.spheres[0].center == core::Vec3d{1, 2, 3});
  CHECK(scene.spheres[0].radius == 4);
  CHECK(scene.spheres[2].radius == 7);
  CHECK_FALSE(scene.lights[0].has_color);
}

TEST_CASE("numbers are what printing makes them: minus zero, tiny, with exponent, negative radii, a plus sign") {
  const core::Scene scene = read_text(view + "s -0 5.14416e-18 1E5 -2\ns +1 .5 5. 1\nc 0 0 0 -1 0 0 1 -1\n");
  CHECK(std::signbit(scene.spheres[0].center.x));
  CHECK(scene.spheres[0].center.y == 5.14416e-18);
  CHECK(scene.spheres[0].center.z == 100000);
  CHECK(scene.spheres[0].radius == -2);
  CHECK(scene.spheres[1].center == core::Vec3d{1, 0.5, 5});
  CHECK(scene.cones[0].base_radius == -1);
}

TEST_CASE("surplus numbers after a material or a light's colour are ignored to the end of the line") {
  const core::Scene scene = read_text(view + "f 1 1 1 1 0 0 0 0 0.5 0.5\nl 1 2 3 1 1 1 9 9\ns 0 0 0 1\n");
  CHECK(scene.materials.size() == 1);
  CHECK(scene.lights.size() == 1);
  CHECK(scene.objects.size() == 1);
}

TEST_CASE("a line is read whole, however long, and the next one is counted as such") {
  for (const std::size_t length : {4088U, 4093U, 4094U, 4095U, 4096U, 4097U, 8190U, 8191U, 8192U, 100'000U}) {
    CAPTURE(length);
    const std::string line = "b 0.25 0.5" + std::string(length, ' ') + "0.75";
    const core::Vec3d color{0.25, 0.5, 0.75};
    CHECK(read_text(view + line).background == color);
    CHECK(read_text(view + line + "\n").background == color);
    check_refused(line + "\nwrong", "'wrong'", "a.nff:9: ");
  }
}

TEST_CASE("reading a short file takes little memory") {
  std::istringstream input(view);
  const std::string name = "a.nff";
  const auto allocated = [] {
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  const std::size_t before = allocated();
  apps::NffTokens tokens(input, name);
  CHECK(tokens.take() == "v");
  CHECK(allocated() < before + 100'000);
}

TEST_CASE("a byte order mark at the beginning of a file is skipped, and nowhere else") {
  const std::string mark = "\xef\xbb\xbf";
  CHECK(read_text(mark + view + "s 0 0 0 1\n").objects.size() == 1);
  check_refused(mark + "s 0 0 0 1\n", "found '???s'");
}

TEST_CASE("objects before the first material get the default material") {
  const core::Scene scene = read_text("s 0 0 0 1\n" + view);
  core::Material plain;
  plain.color = apps::plain_color;
  CHECK(scene.materials.at(scene.objects.at(0).material) == plain);
}

TEST_CASE("a file without a whole view is refused with what is missing") {
  tests::check_complaints(message_of, tests::complaints_in(refusals, "in place of the view"));
}

TEST_CASE("what is wrong behind a view is refused, with its line and what was expected") {
  for (const auto& row : tests::rows_in(refusals, 3, "behind the view")) {
    check_refused(row[1], row[2], "a.nff:" + row[0] + ": ");
  }
}

TEST_CASE("an unknown keyword is refused with its line") {
  CHECK(message_of(std::string("\x01\0Z", 3)).starts_with("a.nff:1: found '?\?Z',"));
  CHECK(message_of(std::string(100000, 'x')).size() < 200);
}

TEST_CASE("a number that is malformed, not finite or out of range of doubles is refused") {
  for (const char* number : {"nan", "inf", "-inf", "1e400", "1x", "--1", "+-1", "0x10", "1,5", "1.2.3", "-", "+", "."}) {
    check_refused(std::string("s 0 0 0 ") + number, std::string("found '") + number + "', expected the radius of s (sphere)");
  }
}

TEST_CASE("a vertex count below 3, absurd, or no integer is refused") {
  for (const char* count : {"0", "1", "2", "-3", "3.5", "70000", "1e300"}) {
    check_refused(std::string("p ") + count + " 0 0 0",
                  "as the number of vertices of p (polygon), expected an integer from 3 to 65535");
    check_refused(std::string("pp ") + count, "as the number of vertices of pp (polygonal patch)");
  }
}

TEST_CASE("cutting any tail off a small file is an error or leaves a valid beginning, never anything else") {
  const std::string text = "b 0.5 0.5 0.5\n" + view + "l 1 2 3\nf 1 1 1 1 0 0 0 0\np 3\n0 0 0\n1 0 0\n0 1 0\nc 0 0 0 1 0 0 2 1\n";
  int accepted = 0;
  for (std::size_t length = 0; length <= text.size(); ++length) {
    accepted += message_of(text.substr(0, length)).empty() ? 1 : 0;
  }
  CHECK(accepted > 3);
  CHECK(accepted < 30);
}

TEST_CASE("a second view or background is refused with the line of the first") {
  CHECK(message_of("b 0 0 0\nb 0 0 0\n").find("a.nff:2: found a second 'b' (the first stands on line 1)") == 0);
}

TEST_CASE("a view that makes no picture is refused, by the part that is wrong") {
  const auto complaint = [](const std::string& line) { return message_of(view_with(line.substr(0, line.find(' ')), line)); };
  tests::check_complaints(complaint, tests::complaints_in(refusals, "in place of a part of the view"));
  CHECK(read_text(view_with("resolution", "resolution 64.0 1e2")).view.height == 100);
}

TEST_CASE("a light's colours and a diffuse share may be above one") {
  CHECK(message_of(view + "l 0 0 0 10 10 10\nf 1 1 1 1.5 0 0 0 0\n").empty());
}

TEST_CASE("a transmitter needs an index of refraction, an opaque material does not") {
  CHECK(message_of(view + "f 1 1 1 0 0 0 0 0").empty());
}

TEST_CASE("a cone with radii of different sign is refused, a pointed one of either sign is not") {
  CHECK(message_of(view + "c 0 0 0 1 0 0 1 0\nc 0 0 0 -1 0 0 1 0\n").empty());
}

TEST_CASE("degenerate objects are kept for the database to count") {
  const core::Scene scene = read_text(view + "s 0 0 0 0\np 3 0 0 0 0 0 0 0 0 0\nc 1 1 1 1 1 1 1 1\n");
  CHECK(scene.objects.size() == 3);
}

TEST_CASE("a file is read, and a path that is a folder or leads nowhere is refused by name") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.nff", view + "s 0 0 0 1\n");
  CHECK(apps::read_nff_file(folder / "a.nff").objects.size() == 1);
  CHECK_THROWS_WITH_AS(apps::read_nff_file(folder / "b.nff"), doctest::Contains("cannot be opened: No such file"),
                       core::InputError);
  CHECK_THROWS_WITH_AS(apps::read_nff_file("/"), doctest::Contains("/: is a folder"), core::InputError);
}

TEST_CASE("progress counts the bytes of a file, up to what it has") {
  const tests::TemporaryFolder folder;
  const std::string text = view + tests::repeated(3000, "s 0 0 0 1\n");
  tests::write_text(folder / "a.nff", text);
  const std::uint64_t size = text.size();
  std::vector<std::uint64_t> steps;
  apps::read_nff_file(folder / "a.nff", apps::picture_pixels_max, [&](std::uint64_t done, std::uint64_t total) {
    CHECK(done <= total);
    CHECK(total == size);
    steps.push_back(done);
  });
  REQUIRE(steps.size() >= 2);
  CHECK(steps[0] < steps[1]);
  CHECK(steps[0] > size / 4);
}

}  // namespace nff_reader_test
