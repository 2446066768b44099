#include "apps/render/checkpoint_file.h"

#include <fcntl.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <istream>
#include <limits>
#include <span>
#include <streambuf>
#include <string>
#include <vector>

#include "apps/frontend/line/words.h"
#include "apps/frontend/system/digest.h"
#include "apps/frontend/system/files.h"
#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_words = "dmpc checkpoint ";
constexpr char format = '4';

struct PixelRecord {
  core::PixelSums sums;
  std::uint64_t samples = 0;
};
static_assert(sizeof(PixelRecord) == 56 && std::is_trivially_copyable_v<PixelRecord>);

static_assert(sizeof(core::PixelPast) == 36 && std::is_trivially_copyable_v<core::PixelPast>);

/// Settings and digests of less than 2 KiB, as a rule.
constexpr std::size_t head_bytes_max = 65536;

/// Written and read at a time.
constexpr std::uint32_t block_pixels = 4096;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw core::InputError("--checkpoint " + path.string() + ": " + what);
}

std::string head_of(const PictureIdentity& identity) {
  const std::string text = std::string(first_words) + format + "\n" + joined(identity.facts, "", [&](const PictureFact& fact) {
                             return fact.name + "=" + fact.value + "\n";
                           });
  return text + "\n";
}

/// Bytes to a file and a digest of them.
class Writer {
 public:
  explicit Writer(std::ostream& stream) : stream_(stream) {}

  void put(std::span<const std::byte> bytes) {
    digest_.add(bytes);
    stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  void put_end() {
    const std::uint64_t digest = digest_.value();
    put(std::as_bytes(std::span(&digest, 1)));
  }

 private:
  std::ostream& stream_;
  Digest digest_;
};

void put_pixels(Writer& writer, const core::Film& film) {
  const auto pixel_count = static_cast<std::uint32_t>(film.pixel_count());
  std::vector<PixelRecord> block;
  for (std::uint32_t first = 0; first < pixel_count; first += block_pixels) {
    block.clear();
    for (std::uint32_t pixel = first; pixel < std::min(first + block_pixels, pixel_count); ++pixel) {
      block.push_back({film.sums(pixel), film.samples(pixel)});
    }
    writer.put(std::as_bytes(std::span(block)));
  }
}

/// The steps of all pixels, filled up to whole words.
std::vector<std::uint8_t> step_bytes(std::size_t pixel_count) {
  return std::vector<std::uint8_t>(core::round_up(pixel_count, sizeof(std::uint64_t)));
}

void put_pass(Writer& writer, const core::Refinement& refinement) {
  const std::uint64_t number = refinement.result().passes;
  const auto steps = refinement.pass().steps();
  std::vector<std::uint8_t> bytes = step_bytes(steps.size());
  std::transform(steps.begin(), steps.end(), bytes.begin(), [](const core::SampleStep& step) { return step.bits(); });
  writer.put(std::as_bytes(std::span(&number, 1)));
  writer.put(std::as_bytes(std::span(bytes)));
}

constexpr std::size_t read_bytes_kept = 65536;

/// A stream from a file that Files opens, which distinguishes the end of the file from an error. Not thread-safe. `files`
/// outlives it.
class FileSource final : private std::streambuf, public std::istream {
 public:
  /// The first read fails if there is no such file.
  FileSource(const std::filesystem::path& path, Files& files) : std::istream(this), files_(files), kept_(read_bytes_kept) {
    do {
      file_ = files.open(path, O_RDONLY);
    } while (file_ < 0 && errno == EINTR);
    if (file_ < 0) {
      error_ = errno;
      setstate(std::ios::failbit);
    }
  }

  ~FileSource() override {
    if (file_ >= 0) {
      files_.close(file_);
    }
  }

  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  /// Returns 0, or the errno of the first call that failed: then the data are incomplete.
  int error() const { return error_; }

 private:
  std::streambuf::int_type underflow() override {
    ssize_t count = -1;
    while (error_ == 0 && (count = files_.read(file_, kept_)) < 0) {
      error_ = errno == EINTR ? 0 : errno;
    }
    if (count <= 0) {
      return std::char_traits<char>::eof();
    }
    setg(kept_.data(), kept_.data(), kept_.data() + count);
    return std::char_traits<char>::to_int_type(*gptr());
  }

  Files& files_;
  int file_ = -1;
  int error_ = 0;
  std::vector<char> kept_;
};

/// Bytes from a file, and whether they are those that were written.
class Reader {
 public:
  Reader(const fs::path& path, Files& files) : path_(path), stream_(path, files) { check_read(); }

  std::vector<PictureFact> take_head() {
    std::string head(first_words.size() + 2, ' ');
    stream_.read(head.data(), static_cast<std::streamsize>(head.size()));
    check_read();
    const char found = head[first_words.size()];
    if (!stream_ || !head.starts_with(first_words) || !head.ends_with('\n')) {
      fail(path_, "this is no checkpoint of dmpc");
    }
    if (found != format) {
      fail(path_, std::string("this is no checkpoint of this version of dmpc: its format is ") + found + ", here " + format +
                      " is read");
    }
    std::vector<PictureFact> facts;
    for (std::string line = take_line(head); !line.empty(); line = take_line(head)) {
      const std::size_t sign = line.find('=');
      check(sign != std::string::npos);
      facts.push_back({line.substr(0, sign), line.substr(sign + 1)});
    }
    digest_.add(std::as_bytes(std::span(head)));
    return facts;
  }
  template <class T>
  void take(std::span<T> values) {
    const std::span<std::byte> bytes = std::as_writable_bytes(values);
    stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    check(bool{stream_});
    digest_.add(std::span<const std::byte>(bytes));
  }
  void take_end() {
    const std::uint64_t expected = digest_.value();
    std::uint64_t digest = 0;
    take(std::span(&digest, 1));
    check(digest == expected && stream_.peek() == std::istream::traits_type::eof());
    check_read();
  }
  void check(bool is_whole) const {
    check_read();
    if (!is_whole) {
      fail(path_, "this checkpoint is damaged or cut short: remove it and start again without --resume");
    }
  }
  void refuse(const std::string& impossible) const {
    fail(path_, "this checkpoint is damaged, it contains " + impossible + ": remove it and start again without --resume");
  }
  /// A number that has more room in the file than it can need.
  std::uint32_t narrow(std::uint64_t number) const {
    check(number <= std::numeric_limits<std::uint32_t>::max());
    return static_cast<std::uint32_t>(number);
  }

 private:
  /// The file may be whole, and the disk at fault.
  void check_read() const {
    if (stream_.error() != 0) {
      fail(path_, std::string("cannot be read: ") + std::strerror(stream_.error()));
    }
  }
  /// The next line, without its end; with it, it is added to `head`, which a file of something else must not fill for ever.
  std::string take_line(std::string& head) {
    const std::size_t begin = head.size();
    for (char character = ' '; character != '\n'; head += character) {
      check(head.size() < head_bytes_max && bool{stream_.get(character)});
    }
    return head.substr(begin, head.size() - begin - 1);
  }

  fs::path path_;
  FileSource stream_;
  Digest digest_;
};

void take_pixels(Reader& reader, core::Film& film) {
  const auto pixel_count = static_cast<std::uint32_t>(film.pixel_count());
  std::vector<PixelRecord> block;
  for (std::uint32_t first = 0; first < pixel_count; first += block_pixels) {
    block.resize(std::min(block_pixels, pixel_count - first));
    reader.take(std::span(block));
    for (std::uint32_t i = 0; i < block.size(); ++i) {
      film.deposit(first + i, block[i].sums);
      film.add_samples(first + i, reader.narrow(block[i].samples));
    }
  }
}

void take_steps(Reader& reader, core::Pass& pass) {
  std::vector<std::uint8_t> bytes = step_bytes(pass.steps().size());
  reader.take(std::span(bytes));
  for (std::size_t pixel = 0; pixel < bytes.size(); ++pixel) {
    if (pixel < pass.steps().size()) {
      pass.steps()[pixel] = core::SampleStep::of_bits(bytes[pixel]);
    } else {
      reader.check(bytes[pixel] == 0);
    }
  }
}

}  // namespace

void write_checkpoint(const fs::path& path, const PictureIdentity& identity, const core::Film& film, const core::Refinement& pass,
                      const core::PixelMask& done, Files& files) {
  OutputFile file(path, {.name = TemporaryName::of_target, .option = "--checkpoint"}, files);
  Writer writer(file.stream());
  const std::string head = head_of(identity);
  writer.put(std::as_bytes(std::span(head)));
  put_pass(writer, pass);
  writer.put(std::as_bytes(done.words()));
  put_pixels(writer, film);
  if (!pass.past().empty()) {
    writer.put(std::as_bytes(pass.past()));
  }
  writer.put_end();
  file.commit();
}

core::PartialPicture read_checkpoint(const fs::path& path, const PictureIdentity& identity, Files& files) {
  Reader reader(path, files);
  const std::vector<PictureFact> facts = reader.take_head();
  if (const std::string difference = difference_text(facts, identity.facts); !difference.empty()) {
    fail(path, "this is the checkpoint of another picture: " + difference);
  }
  reader.check(facts == identity.facts);
  std::uint64_t passes = 0;
  reader.take(std::span(&passes, 1));
  const auto pixel_count = static_cast<std::uint32_t>(identity.width) * static_cast<std::uint32_t>(identity.height);
  core::PartialPicture picture{core::Film(identity.width, identity.height, identity.terms.film_scale), reader.narrow(passes),
                               core::Pass(pixel_count, identity.terms.samples), core::PixelMask(pixel_count)};
  take_steps(reader, picture.pass);
  reader.take(picture.done.words());
  take_pixels(reader, picture.film);
  if (identity.terms.refinement.is_wanted()) {
    picture.past.resize(pixel_count);
    reader.take(std::span(picture.past));
  }
  reader.take_end();
  if (const char* const fault = core::fault_of(picture, identity.terms)) {
    reader.refuse(fault);
  }
  return picture;
}

}  // namespace dmpc::apps
