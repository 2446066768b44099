#include "apps/frontend/table/plot_program.h"

#include <doctest/doctest.h>

#include <csignal>
#include <string>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::plot_program_test {

using namespace apps;

namespace {

Table two_times() {
  Table table("Times", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  table.add_row({std::uint64_t{2}, 5.0});
  return table;
}

Plot small_plot(PlotMark mark = PlotMark::line) {
  return {.name = "times",
          .title = "Times",
          .places = {"nodes"},
          .x = {.label = "nodes"},
          .y = {.label = "time (s)", .least = 0},
          .series = {{"ours", "time", {}, mark, 0}}};
}

/// A folder with the table's file.
class Drawing {
 public:
  Drawing() { write_text(folder_ / "t.csv", text_of(table_, TableFormat::csv)); }

  std::optional<PlotOutcome> draw(const std::string& program = "gnuplot", const Plot& plot = small_plot()) const {
    return apps::draw(plot, table_, folder_.path(), "t.csv", program);
  }
  /// A program of its own, by its lines.
  std::string program(const std::string& lines) const {  // bash, unlike sh, leaves blocked signals as they are
    const std::filesystem::path path = folder_ / "program";
    write_text(path, "#!/bin/bash\n" + lines);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string text(const std::string& name) const { return file_text(folder_ / name); }
  void write(const std::string& name) const { write_text(folder_ / name, "old"); }

  Table& table() { return table_; }

 private:
  TemporaryFolder folder_;
  Table table_ = two_times();
};

}  // namespace

TEST_CASE("gnuplot draws curves, points and bars") {
  for (const PlotMark mark : {PlotMark::line, PlotMark::points, PlotMark::bars}) {
    const Drawing drawing;
    const auto outcome = drawing.draw("gnuplot", small_plot(mark));
    REQUIRE(outcome);
    CHECK(outcome->complaint.empty());
    CHECK(outcome->is_drawn);
    CHECK(contains(drawing.text("times.svg"), "</svg>"));
    CHECK(contains(drawing.text("times.svg"), ">ours<"));
  }
}

TEST_CASE("the same table gives the same picture") {
  const Drawing drawing;
  drawing.draw();
  const std::string first = drawing.text("times.svg");
  drawing.draw();
  CHECK(drawing.text("times.svg") == first);
}

TEST_CASE("without the program the script stays, an old picture goes, and one sentence says why") {
  const Drawing drawing;
  drawing.write("times.svg");
  const auto outcome = drawing.draw("no-such-program-anywhere");
  REQUIRE(outcome);
  CHECK(outcome->is_program_missing);
  CHECK_FALSE(outcome->is_drawn);
  CHECK(outcome->complaint == "no-such-program-anywhere cannot be started: No such file or directory");
  CHECK(drawing.has("times.gnuplot"));
  CHECK_FALSE(drawing.has("times.svg"));
}

TEST_CASE("a program that fails is quoted, and its half of a picture goes") {
  const Drawing drawing;
  const auto outcome =
      drawing.draw(drawing.program("echo half > times.svg; echo >&2 'line 3:   no'; echo >&2 terminal; exit 4\n"));
  REQUIRE(outcome);
  CHECK_FALSE(outcome->is_drawn);
  CHECK_FALSE(outcome->is_program_missing);
  CHECK(contains(outcome->complaint, "could not draw times.svg, its exit status is 4: line 3: no terminal"));
  CHECK_FALSE(drawing.has("times.svg"));
}

TEST_CASE("a program that draws nothing has failed, and so has one that a signal ended") {
  const Drawing drawing;
  CHECK_FALSE(drawing.draw(drawing.program("exit 0\n"))->is_drawn);
  CHECK(contains(drawing.draw(drawing.program("kill -TERM $$\n"))->complaint, "ended by signal 15"));
}

TEST_CASE("a program that says very much is cut short and waited for") {
  const Drawing drawing;
  const auto outcome = drawing.draw(drawing.program("head -c 300000 /dev/zero | tr '\\0' x >&2; exit 1\n"));
  REQUIRE(outcome);
  CHECK(outcome->complaint.size() < 3000);
}

TEST_CASE("a program runs in the folder, with the script's name, nothing to read, and no signal blocked") {
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const Drawing drawing;
  const auto outcome = drawing.draw(
      drawing.program("cat; test -e t.csv || exit 1; echo $1 >times.svg; exec grep SigBlk /proc/self/status >>times.svg\n"));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  REQUIRE(outcome);
  CHECK(outcome->is_drawn);
  CHECK(contains(drawing.text("times.svg"), "times.gnuplot\nSigBlk:\t0000000000000000"));
}

TEST_CASE("a table without rows is not drawn, and leaves nothing of an older one") {
  Drawing drawing;
  drawing.write("times.svg");
  drawing.write("times.gnuplot");
  drawing.table() = Table("Times", two_times().columns());
  CHECK_FALSE(drawing.draw().has_value());
  CHECK_FALSE(drawing.has("times.svg"));
  CHECK_FALSE(drawing.has("times.gnuplot"));
}

TEST_CASE("a folder that is not there is bad input") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(draw(small_plot(), two_times(), folder / "none", "t.csv"), core::InputError);
}

}  // namespace dmpc::tests::plot_program_test
