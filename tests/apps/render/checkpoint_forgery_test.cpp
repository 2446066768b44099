// Checkpoints that somebody has forged, each with the digest that goes with it: they are refused as bad input, or a render goes
// on with them to its end. DMPC_FORGERIES in the environment: how many are tried.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/system/digest.h"
#include "apps/render/checkpoint_file.h"
#include "core/base/expect.h"
#include "core/picture/shade.h"
#include "tests/support/environment.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::checkpoint_forgery_test {

using tests::contains;
using tests::file_text;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

constexpr std::size_t word_bytes = sizeof(std::uint64_t);
constexpr std::size_t pixel_bytes = 7 * word_bytes, past_bytes = 9 * sizeof(float);

std::size_t forgery_count() { return tests::number_from_environment("DMPC_FORGERIES", 300); }

/// A render that stops when it has kept the picture, and what it kept.
struct Forged {
  Forged(const tests::Subject::Size& size, std::uint32_t keeps_before_stop)
      : subject(tests::mirrors_and_glass(), size), identity{size.width, size.height, {{"depth", "5"}, {"objects", "#1"}}, {}} {
    identity.terms = {static_cast<std::uint32_t>(size.samples), size.refinement,
                      core::radiance_bound(tests::mirrors_and_glass(), 6)};
    std::stop_source stop;
    svm::RunOptions options{.computer = {.node_count = 2}, .pages = {.work_item_side = 3}};
    std::uint32_t left = 0;
    options.continuation = {nullptr, [] { return true; },
                            [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
                              if (left > 0 && --left == 0) {
                                write_checkpoint(folder / "genuine", identity, film, pass, done);
                                stop.request_stop();
                              }
                            }};
    // On a busy computer so many pixels may come at a time that a run is asked less often.
    for (int attempt = 0; attempt < 100 && genuine.empty(); ++attempt) {
      left = keeps_before_stop;
      svm::run_svm(subject.database(), subject.settings(), options, stop.get_token());
      genuine = file_text(folder / "genuine");
    }
    core::expect(!genuine.empty(), "a checkpoint was written");
    const std::size_t head = genuine.find("\n\n") + 2;
    const auto pixels = static_cast<std::size_t>(size.width * size.height);
    parts = {head, word_bytes, (pixels + 7) / 8 * word_bytes, (pixels + 63) / 64 * word_bytes, pixels * pixel_bytes};
    if (size.refinement.is_wanted()) {
      parts.push_back(pixels * past_bytes);
    }
  }

  /// The digest of these bytes as the file's parts are read; there are fewer pixels than are read at a time.
  std::uint64_t digest_of(std::span<const std::byte> bytes) const {
    Digest digest;
    for (const std::size_t part : parts) {
      digest.add(bytes.first(std::min(part, bytes.size())));
      bytes = bytes.subspan(std::min(part, bytes.size()));
    }
    return digest.value();
  }
  std::string with_digest(std::string text) const {
    const std::uint64_t digest = digest_of(std::as_bytes(std::span(text)));
    return text.append(reinterpret_cast<const char*>(&digest), sizeof(digest));
  }
  std::string body() const { return genuine.substr(0, genuine.size() - word_bytes); }

  TemporaryFolder folder;
  tests::Subject subject;
  PictureIdentity identity;
  std::string genuine;
  std::vector<std::size_t> parts;  ///< bytes: head, pass, its steps, pixels that are done, the film, what is remembered of it
};

/// Changes a word of some part to another, likely one that matters.
void change_word(std::string& text, const std::vector<std::size_t>& parts, std::mt19937_64& random) {
  std::size_t part = random() % parts.size(), begin = 0;
  for (std::size_t i = 0; i < part; ++i) {
    begin += parts[i];
  }
  const std::size_t place = begin + random() % (parts[part] / word_bytes) * word_bytes;
  std::uint64_t word = 0;
  std::memcpy(&word, text.data() + place, word_bytes);
  const std::uint64_t choices[] = {0,        1,
                                   ~word,    random(),
                                   word + 1, word - 1,
                                   word * 2, word ^ std::uint64_t{1} << random() % 64,
                                   1U << 31, (word & 0xffffffffU) | random() << 32U};
  word = choices[random() % std::size(choices)];
  std::memcpy(text.data() + place, &word, word_bytes);
}

std::string forge(const Forged& forged, std::mt19937_64& random) {
  std::string text = forged.body();
  for (auto changes = random() % 3 + 1; changes > 0; --changes) {
    change_word(text, forged.parts, random);
  }
  if (random() % 16 == 0) {
    text.resize(random() % (text.size() + 100), 'x');
  }
  return forged.with_digest(text);
}

enum class Reaction { refused, rendered };

/// Throws what is no bad input.
Reaction reaction_to(const Forged& forged, const std::string& text, std::mt19937_64& random) {
  write_text(forged.folder / "forged", text);
  std::optional<core::PartialPicture> start;
  try {
    start.emplace(read_checkpoint(forged.folder / "forged", forged.identity));
  } catch (const core::InputError&) {
    return Reaction::refused;
  }
  const core::Continuation continuation{.start = &*start};
  if (random() % 2 == 0) {
    tests::run_svm(forged.subject, {.computer = {.node_count = 2}, .continuation = continuation});
  } else {
    tests::run_dataflow(forged.subject, {.computer = {.node_count = 2}, .continuation = continuation});
  }
  return Reaction::rendered;
}

void try_forgeries(const Forged& forged, std::size_t count) {
  std::mt19937_64 random(20261122);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    CAPTURE(i);
    const std::string text = forge(forged, random);
    Reaction reaction = Reaction::rendered;
    REQUIRE_NOTHROW(reaction = reaction_to(forged, text, random));
    refused += reaction == Reaction::refused ? 1 : 0;
  }
  MESSAGE(refused << " of " << count << " are refused");
  CHECK(refused > count / 2);
  CHECK(forged.with_digest(forged.body()) == forged.genuine);
}

}  // namespace

TEST_CASE("a forged checkpoint of a first pass is refused, or rendered to its end") {
  try_forgeries(Forged({12, 9, 3}, 3), forgery_count() / 3);
}

TEST_CASE("a forged checkpoint of a picture that is refined is refused, or rendered to its end") {
  const tests::Subject::Size size{12, 9, 2, {.error = 0.005}};
  try_forgeries(Forged(size, 4), forgery_count() / 3);
  try_forgeries(Forged(size, 6), forgery_count() / 3);
}

TEST_CASE("who reads a forged checkpoint is told what it says that cannot be") {
  const Forged forged({12, 9, 3}, 3);
  std::string text = forged.body();
  text[forged.parts[0]] = 2;
  write_text(forged.folder / "forged", forged.with_digest(text));
  CHECK_THROWS_WITH_AS(read_checkpoint(forged.folder / "forged", forged.identity),
                       doctest::Contains("damaged, it contains a pass that the picture does not have: remove it and start again"),
                       core::InputError);
}

TEST_CASE("a fact that a checkpoint says twice is damage") {
  const Forged forged({12, 9, 3}, 3);
  const std::string text = forged.genuine;
  write_text(forged.folder / "forged", text.substr(0, forged.parts[0] - 1) + "depth=4\n" + text.substr(forged.parts[0] - 1));
  CHECK_THROWS_WITH_AS(read_checkpoint(forged.folder / "forged", forged.identity), doctest::Contains("is damaged"),
                       core::InputError);
}

}  // namespace dmpc::apps::checkpoint_forgery_test
