// Changes to genuine checkpoints, by any bytes, each with the digest that goes with it, or any bytes as a checkpoint: refused
// with core::InputError, or a render goes on with it to its end, and what it keeps on the way could have come about, too.

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/system/digest.h"
#include "apps/render/checkpoint_file.h"
#include "core/base/expect.h"
#include "core/picture/shade.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/targets.h"
#include "tests/support/priced_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::fuzz {

namespace {

constexpr std::size_t word_bytes = sizeof(std::uint64_t);
constexpr std::size_t pixel_bytes = 7 * word_bytes, past_bytes = sizeof(core::PixelPast);
constexpr int side = 3;
constexpr std::size_t pixels = side * side;

/// A file without a name.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("checkpoint", 0)) { core::expect(descriptor_ >= 0, "there is a file in memory"); }

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  void put(const std::string& bytes) {
    const bool is_put = ::ftruncate(descriptor_, 0) == 0 &&
                        ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    core::expect(is_put, "memory takes it");
  }

 private:
  int descriptor_;
};

/// A picture of nine pixels, and what several of its runs kept when they were stopped.
class Picture {
 public:
  Picture(int samples, const core::RefinementOptions& refinement)
      : subject_(tests::mirrors_and_glass(), {side, side, samples, refinement}),
        identity_{side, side, {{"depth", "5"}, {"objects", "#1"}, {apps::film_scale_fact, "1"}}, {}} {
    identity_.terms = {static_cast<std::uint32_t>(samples), refinement, core::radiance_bound(tests::mirrors_and_glass(), 6)};
    for (const std::uint32_t keeps : {1U, 2U, 3U, 4U}) {
      keep(keeps);
    }
    core::expect(!genuine_.empty(), "runs keep what they have");
  }

  const std::vector<std::string>& genuine() const { return genuine_; }
  const apps::PictureIdentity& identity() const { return identity_; }

  std::string with_digest(std::string text) const {
    const std::size_t head = genuine_.front().find("\n\n") + 2;
    apps::Digest digest;
    auto bytes = std::as_bytes(std::span(text));
    std::vector<std::size_t> parts = {head, word_bytes, 2 * word_bytes, word_bytes, pixels * pixel_bytes};
    if (identity_.terms.refinement.is_wanted()) {
      parts.push_back(pixels * past_bytes);
    }
    for (const std::size_t part : parts) {
      const std::size_t count = std::min(part, bytes.size());
      digest.add(bytes.first(count));
      bytes = bytes.subspan(count);
    }
    const std::uint64_t value = digest.value();
    return text.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  /// Renders what is left. With every deposit it looks at what a checkpoint would have.
  void finish(const core::PartialPicture& start, bool by_dataflow) const {
    core::Continuation continuation{.start = &start};
    continuation.is_due = [] { return true; };
    continuation.keep = [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
      const core::PartialPicture kept = core::partial_picture(film, pass, done);
      core::expect(core::fault_of(kept, identity_.terms) == nullptr, "what is kept on the way could have come about");
    };
    const auto machine = tests::priced_machine();
    const nodes::RunEnd end =
        by_dataflow
            ? tests::run_dataflow(subject_, {.computer = {.node_count = 2, .machine = machine}, .continuation = continuation}).end
            : tests::run_svm(subject_, {.computer = {.node_count = 2, .machine = machine}, .continuation = continuation}).end;
    core::expect(end == nodes::RunEnd::finished, "who goes on comes to the end");
  }

 private:
  /// Stops a run when it has kept the picture so often.
  void keep(std::uint32_t keeps) {
    const tests::TemporaryFolder folder;
    std::stop_source stop;
    svm::RunOptions options{.computer = {.node_count = 1, .machine = tests::priced_machine()}, .pages = {.work_item_side = 1}};
    options.continuation = {nullptr, [] { return true; },
                            [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
                              if (keeps > 0 && --keeps == 0) {
                                apps::write_checkpoint(folder / "genuine", identity_, film, pass, done);
                                genuine_.push_back(tests::file_text(folder / "genuine"));
                                stop.request_stop();
                              }
                            }};
    svm::run_svm(subject_.database(), subject_.settings(), options, stop.get_token());
  }

  tests::Subject subject_;
  apps::PictureIdentity identity_;
  std::vector<std::string> genuine_;
};

const Picture& picture(std::size_t number) {
  static const std::array<Picture, 2> all{Picture(3, {}), Picture(2, {.error = 0.02})};
  return all[number % all.size()];
}

std::uint64_t changed(std::uint64_t word, std::uint64_t other, tests::Bytes& bytes) {
  switch (bytes.below(10)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return ~word;
    case 3:
      return word + bytes.byte();
    case 4:
      return word - bytes.byte();
    case 5:
      return word * 2;
    case 6:
      return word ^ std::uint64_t{1} << bytes.below(64);
    case 7:
      return other;
    case 8:
      return bytes.byte();
    default: {
      std::uint64_t value = 0;
      for (std::size_t i = 0; i < word_bytes; ++i) {
        value = value << 8U | bytes.byte();
      }
      return value;
    }
  }
}

/// Which word, and how; again and again.
std::string forged(const Picture& of, tests::Bytes& bytes) {
  const std::vector<std::string>& genuine = of.genuine();
  std::string text = genuine[bytes.byte() % genuine.size()];
  text.resize(text.size() - word_bytes);
  const std::size_t head = text.find("\n\n") + 2, words = (text.size() - head) / word_bytes;
  const auto place = [&] { return text.data() + head + bytes.byte() % words * word_bytes; };
  while (!bytes.empty()) {
    char* const at = place();
    std::uint64_t word = 0, other = 0;
    std::memcpy(&word, at, word_bytes);
    std::memcpy(&other, place(), word_bytes);
    word = changed(word, other, bytes);
    std::memcpy(at, &word, word_bytes);
  }
  return of.with_digest(text);
}

}  // namespace

void try_checkpoint(const std::uint8_t* data, std::size_t size) {
  static MemoryFile file;
  tests::Bytes bytes(data, size);
  const std::uint8_t choice = bytes.byte();
  const Picture& of = picture(choice);
  const bool is_raw = choice % 16 == 15;
  file.put(is_raw ? std::string(data + std::min<std::size_t>(size, 1), data + size) : forged(of, bytes));
  const bool by_dataflow = choice / 2 % 2 == 1;
  covered().count("any bytes", is_raw);
  covered().count("forged", !is_raw);
  std::optional<core::PartialPicture> start;
  try {
    start.emplace(apps::read_checkpoint(file.path(), of.identity()));
  } catch (const core::InputError& error) {
    core::expect(!std::string(error.what()).empty(), "who refuses says why");
  }
  covered().count("refused", !start);
  const bool is_refined = of.identity().terms.refinement.is_wanted();
  for (const bool is_dataflow : {false, true}) {
    const std::string by = is_dataflow ? " by dataflow" : " by svm";
    const bool is_gone_on_with = start && by_dataflow == is_dataflow;
    covered().count("plain, gone on with" + by, is_gone_on_with && !is_refined);
    covered().count("refined, gone on with in the first pass" + by, is_gone_on_with && is_refined && start->passes == 1);
    covered().count("refined, gone on with in a later pass" + by, is_gone_on_with && is_refined && start->passes > 1);
  }
  if (start) {
    of.finish(*start, by_dataflow);
  }
}

}  // namespace dmpc::fuzz
