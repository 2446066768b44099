// A stream that packs what is written into it, as gzip does.
#pragma once

#include <iosfwd>
#include <memory>
#include <ostream>
#include <streambuf>
#include <vector>

namespace dmpc::apps {

/// One member of a gzip file (RFC 1952) without name and time, so that equal texts make equal bytes; takes a few hundred KiB,
/// however long the text is. Not thread-safe.
class GzipStream final : private std::streambuf, public std::ostream {
 public:
  /// `packed` outlives it, and has failed if something could not be written.
  explicit GzipStream(std::ostream& packed);
  ~GzipStream() override;

  /// Writes what is still kept, and the end. Call it once, last.
  void finish();

 private:
  struct Packer;

  int overflow(int character) override;
  bool pack(int flush);

  std::ostream& packed_;
  std::unique_ptr<Packer> packer_;
  std::vector<char> text_, bytes_;
};

}  // namespace dmpc::apps
