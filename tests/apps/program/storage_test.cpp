// Renders whose disk errs and whose computer loses its power, at any call: what was said to be there is there, and who goes on
// comes to the same picture.
//
// tests/storage has more seeds tried, by the variables DMPC_STORAGE_FIRST and DMPC_STORAGE_SEEDS of the environment.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "apps/formats/nff_reader.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/machine/machines.h"
#include "apps/picture/image_file.h"
#include "apps/render/checkpoint_file.h"
#include "apps/render/command.h"
#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "tests/support/complaint.h"
#include "tests/support/coverage.h"
#include "tests/support/environment.h"
#include "tests/support/simulated_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::storage_test {

namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t storage_seeds_by_default = 20;
#else
constexpr std::uint64_t storage_seeds_by_default = 60;
#endif

/// What is said on stderr while it lives.
class Overheard {
 public:
  Overheard() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Overheard() { std::cerr.rdbuf(before_); }
  Overheard(const Overheard&) = delete;
  Overheard& operator=(const Overheard&) = delete;

  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// A picture of 6x6 pixels with a checkpoint wherever there can be one, by the strategy that the seed says, and with it maps, a
/// trace or, seldom, a page.
apps::RenderOptions storage_options(const TemporaryFolder& folder, std::uint64_t seed) {
  apps::RenderOptions options;
  options.picture.scene = "balls-1";
  options.picture.resolution = {6, 6};
  options.picture.samples = 1 + static_cast<int>(seed % 2);
  options.quiet = true;
  options.image = folder / "picture/a.exr";
  options.stats = folder / "picture/s.json";
  options.checkpoint = {.file = folder / "kept/c", .every_seconds = 1e-9, .resumes = true};
  options.strategy = seed % 3 == 0 ? apps::Strategy::svm : seed % 3 == 1 ? apps::Strategy::dataflow : apps::Strategy::replicated;
  options.computer.node_count = 2;
  options.runner.kind = apps::RunnerKind::virtual_time;
  options.runner.machine_name = "ipsc2";
  if (seed % 4 == 1) {
    options.heat_maps = {{core::HeatKind::rays, folder / "picture/h.png"}, {core::HeatKind::time, folder / "picture/h.exr"}};
  }
  if (seed % 4 == 2) {
    options.trace.path = folder / "picture/t.pftrace";
  }
  if (seed % 50 == 3) {
    options.report = folder / "picture/r.html";
  }
  return options;
}

void cover(const apps::RenderOptions& options, Coverage& covered) {
  covered.count("svm", options.strategy == apps::Strategy::svm);
  covered.count("dataflow", options.strategy == apps::Strategy::dataflow);
  covered.count("replicated", options.strategy == apps::Strategy::replicated);
  covered.count("two samples a pixel", options.picture.samples == 2);
  covered.count("heat maps", !options.heat_maps.empty());
  covered.count("a trace", options.trace.path.has_value());
  covered.count("a page", options.report.has_value());
}

/// All seeds that are asked for.
class Seeds {
 public:
  explicit Seeds(const std::string& generator) : covered_("storage, " + generator) {}

  template <class Try>
  void for_each(const Try& attempt) {
    for (std::uint64_t seed = first_; seed < first_ + count_; ++seed) {
      CAPTURE(seed);
      attempt(seed, covered_);
    }
    CHECK(covered_.missed("DMPC_STORAGE_SEEDS", count_ >= seeds_of_all_kinds) == std::vector<std::string>());
  }

 private:
  /// This many seeds cover each kind of case.
  static constexpr std::uint64_t seeds_of_all_kinds = 60;

  std::uint64_t first_ = number_from_environment("DMPC_STORAGE_FIRST", 1);
  std::uint64_t count_ = number_from_environment("DMPC_STORAGE_SEEDS", storage_seeds_by_default);
  Coverage covered_;
};

/// All but the checkpoint.
std::vector<fs::path> output_paths(const apps::RenderOptions& options) {
  std::vector<fs::path> paths{options.image, *options.stats};
  for (const apps::HeatRequest& request : options.heat_maps) {
    paths.push_back(request.path);
  }
  for (const std::optional<fs::path>& path : {options.trace.path, options.report}) {
    if (path) {
      paths.push_back(*path);
    }
  }
  return paths;
}

/// The disk on which a picture is made, as it is between two starts of the program.
class Storage {
 public:
  Storage(std::uint64_t seed, Coverage& covered)
      : covered_(covered), files_(seed), random_(seed ^ 0x5eed), options_(storage_options(folder_, seed)) {
    cover(options_, covered);
    show();
  }

  /// Renders with such faults. Then the power is lost, and what must be there is looked for.
  void attempt(const SimulatedFiles::Faults& faults) {
    files_.begin(faults);
    const Overheard overheard;
    std::ostringstream output;
    apps::Interrupt interrupt;
    const std::uint64_t errors = files_.errors();
    std::string complaint;
    try {
      status_ = apps::render_command(options_, interrupt, output, files_);
    } catch (const core::InputError& error) {  // the checkpoint could not be read
      status_ = 1;
      complaint = error.what();
    }
    const bool had_power = files_.has_power();
    covered_.count("there was a power loss within a run", !had_power);
    covered_.count("there was an error of the disk", files_.errors() > errors);
    covered_.count("there was a disk of short calls", faults.short_every > 0);
    covered_.count("there was a run that said that it failed", status_ != 0);
    covered_.count("there was a checkpoint that cannot be read", !complaint.empty());
    covered_.count("there was an end that was said to be certain", status_ == 0 && had_power);
    CHECK((status_ == 0 || status_ == 1 || status_ == 4));  // 4: no descriptor is left
    CHECK((status_ == 0 || !had_power || files_.errors() > errors));
    CHECK_MESSAGE((status_ == 0 || contains(complaint, "cannot be read: Input/output error") ||
                   contains(complaint, "cannot be read: Too many open files") ||
                   contains(overheard.text(), "cannot be written") || contains(overheard.text(), "loss of power")),
                  overheard.text(), complaint);
    files_.lose_power();
    show();
    check_checkpoint();
    check_outputs(status_ == 0 && had_power);
  }

  SimulatedFiles::Faults draw_faults() {
    return {.power_lasts_calls = random_() % 4 == 0 ? UINT64_MAX : random_() % 64,
            .error_every = random_() % 2 == 0 ? 0 : static_cast<std::uint32_t>(1 + random_() % 200),
            .short_every = random_() % 2 == 0 ? 0 : static_cast<std::uint32_t>(1 + random_() % 10)};
  }
  int status() const { return status_; }
  /// Not the file's bytes, which have the time in them.
  std::vector<float> picture() const { return apps::read_image(options_.image).rgb; }
  std::size_t kept_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_ / "kept"), fs::directory_iterator()));
  }

 private:
  /// Puts what the disk has where the program reads.
  void show() {
    for (const char* const name : {"picture", "kept"}) {
      fs::remove_all(folder_ / name);
      fs::create_directory(folder_ / name);
    }
    for (const auto& [path, bytes] : files_.contents()) {
      write_text(path, bytes);
    }
  }

  /// It is one that was whole, and none before the last that was synced; or there is none because the picture is there.
  void check_checkpoint() {
    const fs::path& path = *options_.checkpoint.file;
    const auto& versions = files_.versions(path);
    const std::size_t certain = files_.certain(path);
    if (!fs::exists(path)) {
      CHECK((certain == 0 || fs::exists(options_.image)));
      return;
    }
    const std::string text = file_text(path);
    covered_.count("there was a checkpoint after a loss of power");
    covered_.count("there was a checkpoint that was certain", certain > 0);
    const auto first = versions.begin() + static_cast<std::ptrdiff_t>(certain == 0 ? 0 : certain - 1);
    CHECK(std::find(first, versions.end(), text) != versions.end());
  }

  /// Each is whole if it is there, and there if all were said to be.
  void check_outputs(bool are_certain) {
    for (const fs::path& path : output_paths(options_)) {
      CAPTURE(path);
      CHECK((!are_certain || fs::exists(path)));
      if (fs::exists(path)) {
        const auto& versions = files_.versions(path);
        CHECK(std::find(versions.begin(), versions.end(), file_text(path)) != versions.end());
      }
    }
    CHECK((!are_certain || contains(file_text(*options_.stats), "film_hash")));
  }

  Coverage& covered_;
  TemporaryFolder folder_;
  SimulatedFiles files_;
  std::mt19937_64 random_;
  apps::RenderOptions options_;
  int status_ = 0;
};

/// The picture of a computer on which nothing goes wrong.
const std::vector<float>& undisturbed_picture(std::uint64_t seed) {
  static std::map<std::uint64_t, std::vector<float>> pictures;
  std::vector<float>& picture = pictures[seed % 2];
  if (picture.empty()) {
    Coverage none("undisturbed");
    Storage storage(seed % 2, none);
    storage.attempt({});
    picture = storage.picture();
  }
  return picture;
}

}  // namespace

TEST_CASE("storage: whatever the disk does and wherever the power goes, who goes on comes to the same picture" *
          doctest::test_suite("slow")) {
  Seeds("pictures").for_each([](std::uint64_t seed, Coverage& covered) {
    Storage storage(seed, covered);
    for (int attempts = 0; attempts < 3; ++attempts) {
      storage.attempt(storage.draw_faults());
    }
    storage.attempt({});
    REQUIRE(storage.status() == 0);
    REQUIRE((storage.picture() == undisturbed_picture(seed)));
    CHECK(storage.kept_count() <= 2);  // whose removal was not synced
  });
}

TEST_CASE("storage: a disk that fails to read is told from a file that is damaged") {
  const fs::path failing = "/proc/self/mem";  // ordinary to look at, and its first byte cannot be read
  for (const std::string& complaint :
       {complaint_of([&] {
          apps::read_checkpoint(failing, {1, 1, {}, {}});
        }),
        complaint_of([&] { apps::read_nff_file(failing); }), complaint_of([&] { apps::load_machine(failing); })}) {
    CHECK_MESSAGE(contains(complaint, "cannot be read: Input/output error"), complaint);
  }
}

}  // namespace dmpc::tests::storage_test
