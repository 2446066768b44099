// What is no database of this program, or is one no more, is refused.

#include "apps/database/database_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/stored_database.h"
#include "tests/support/text.h"

namespace dmpc::tests::database_file_test {

using apps::FileHead, apps::SectionEntry;

namespace {

/// A small file, and what is said of others like it.
class Original {
 public:
  Original() : path_(build_database_file(folder_, {"rings-1", "--transport=paths", "--sky=1"})), text_(file_text(path_)) {}

  const std::string& text() const { return text_; }
  const std::string& path() const { return path_; }

  /// All of it is read; empty if nothing is wrong with it.
  std::string complaint(const std::string& text) const {
    write_text(path_, text);
    return complaint_of([this] {
      const apps::DatabaseFile file(path_);
      static_cast<void>(file.origin());
      static_cast<void>(file.scene());
      static_cast<void>(file.database());
    });
  }

 private:
  TemporaryFolder folder_;
  std::string path_, text_;
};

FileHead head_of(const std::string& text) {
  FileHead head;
  std::memcpy(&head, text.data(), sizeof(head));
  return head;
}

std::string with_head(std::string text, const std::function<void(FileHead&)>& change) {
  FileHead head = head_of(text);
  change(head);
  text.replace(0, sizeof(head), reinterpret_cast<const char*>(&head), sizeof(head));
  return text;
}

std::vector<SectionEntry> sections_of(const std::string& text) {
  std::vector<SectionEntry> sections(head_of(text).section_count);
  std::memcpy(sections.data(), text.data() + sizeof(FileHead), sections.size() * sizeof(SectionEntry));
  return sections;
}

/// With the digests that go with it.
std::string forged(std::string text) {
  std::vector<SectionEntry> sections = sections_of(text);
  for (SectionEntry& section : sections) {
    if (section.offset <= text.size() && section.bytes <= text.size() - section.offset) {
      section.digest = apps::digest_of(std::as_bytes(std::span(text)).subspan(section.offset, section.bytes));
    }
  }
  std::memcpy(text.data() + sizeof(FileHead), sections.data(), sections.size() * sizeof(SectionEntry));
  return with_head(text, [&](FileHead& head) { head.digest = apps::digest_of_head(head, sections); });
}

/// Bytes flipped or set, cut, grown, or two stretches in each other's place.
std::string mutated(std::string text, apps::Random& random) {
  const auto place = [&] { return random.below(text.size()); };
  switch (random.below(5)) {
    case 0:
      text[place()] ^= static_cast<char>(1U << random.below(8));
      break;
    case 1:
      for (std::size_t left = 1 + random.below(16); left > 0; --left) {
        text[place()] = static_cast<char>(random.below(256));
      }
      break;
    case 2:
      text.resize(place());
      break;
    case 3:
      text.append(1 + random.below(100), static_cast<char>(random.below(256)));
      break;
    default: {
      const std::size_t bytes = 1 + random.below(32), first = random.below(text.size() - bytes),
                        second = random.below(text.size() - bytes);
      const std::string moved = text.substr(first, bytes);
      text.replace(first, bytes, text.substr(second, bytes)).replace(second, bytes, moved);
    }
  }
  return text;
}

/// A number in a section that is read as it is, with the digests that go with it.
std::string with_forged_field(std::string text, apps::Random& random) {
  constexpr std::size_t small_sections = 10;  // texts, and what has one size
  const SectionEntry section = sections_of(text)[random.below(small_sections)];
  if (section.bytes == 0) {
    return text;
  }
  for (std::size_t left = 1 + random.below(3); left > 0; --left) {
    text[section.offset + random.below(section.bytes)] = static_cast<char>(random.below(256));
  }
  return forged(text);
}

void check_mutants(std::size_t count, std::uint64_t seed) {
  const Original original;
  apps::Random random(seed);
  std::size_t refused = 0, forgeries_refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    CAPTURE(i);
    const std::string mutant = mutated(original.text(), random);
    const bool is_refused = !original.complaint(mutant).empty();
    refused += is_refused ? 1 : 0;
    CHECK((is_refused || mutant == original.text()));
    forgeries_refused += original.complaint(with_forged_field(original.text(), random)).empty() ? 0 : 1;
  }
  CHECK(refused > count * 9 / 10);
  CHECK(forgeries_refused > count / 20);
}

}  // namespace

TEST_CASE("a file that was cut, grown or changed anywhere is refused, and forged fields are refused or read") {
  check_mutants(1500, 1);
}

TEST_CASE("none of a hundred thousand damaged files is taken for what was written" * doctest::test_suite("slow")) {
  check_mutants(50'000, 2);
}

TEST_CASE("each reason to refuse a file is told, with how to build another") {
  const Original original;
  const auto told = [&](const std::string& text, const std::string& words) {
    const std::string said = original.complaint(text);
    CHECK_MESSAGE(contains(said, words), said);
    CHECK(contains(said, original.path()));
  };
  CHECK(original.complaint(original.text()).empty());
  CHECK(original.complaint(forged(original.text())).empty());
  told("", "is not a database");
  told("v 0 0 0\n" + std::string(1000, ' '), "is not a database");
  told(with_head(original.text(), [](FileHead& head) { ++head.format; }), "it has format 3, and this program reads format 2");
  told(forged(with_head(original.text(), [](FileHead& head) { ++head.program; })), "written by another version of dmpc");
  told(original.text() + " ", "it should have");
  told(original.text().substr(0, original.text().size() - 1), "it should have");
  told(with_head(original.text(), [](FileHead& head) { ++head.bytes; }), "its head is damaged");
  std::string changed = original.text();
  changed.back() ^= 1;
  told(changed, "it is damaged");
  CHECK(contains(original.complaint(changed), "dmpc build SCENE -o FILE.pages"));
}

TEST_CASE("a file that others can change is refused, and so is what is no ordinary file") {
  const Original original;
  CHECK(::chmod(original.path().c_str(), 0666) == 0);
  CHECK(contains(original.complaint(original.text()), "others can change it, since everybody may write to it"));
  CHECK(::chmod(original.path().c_str(), 0600) == 0);
  CHECK(original.complaint(original.text()).empty());
  if (::geteuid() == 0) {
    CHECK(::chown(original.path().c_str(), 4321, static_cast<gid_t>(-1)) == 0);
    CHECK(contains(original.complaint(original.text()), "it belongs to user 4321"));
  }
  const TemporaryFolder folder;
  CHECK(::mkfifo((folder / "a.pages").c_str(), 0600) == 0);
  CHECK(contains(complaint_of([&] { apps::DatabaseFile(folder / "a.pages"); }), "is no ordinary file"));
  CHECK(contains(complaint_of([&] { apps::DatabaseFile(folder / "b.pages"); }), "cannot be read: No such file"));
}

TEST_CASE("a file that was replaced after it was chosen is refused") {
  const TemporaryFolder folder;
  const std::string file = build_database_file(folder, {"rings-1"});
  const apps::RenderOptions options = render_line({file});
  build_database_file(folder, {"rings-1", "--light=1,2,3"});
  CHECK(contains(complaint_of([&] { apps::load_scene(options.picture); }), "replaced since the command began"));
}

}  // namespace dmpc::tests::database_file_test
