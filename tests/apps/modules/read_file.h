// A picture's file as OpenImageIO reads it.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::tests {

class ReadFile {
 public:
  /// The name's ending says which format it is.
  ReadFile(const std::string& name, std::string bytes)
      : bytes_(std::move(bytes)), memory_(bytes_.data(), bytes_.size()), input_(OIIO::ImageInput::open(name, nullptr, &memory_)) {
    REQUIRE(input_ != nullptr);
  }
  ReadFile(const ReadFile&) = delete;
  ReadFile& operator=(const ReadFile&) = delete;

  const OIIO::ImageSpec& spec() const { return input_->spec(); }
  /// All channels, row by row; `type` is T's.
  template <class T>
  std::vector<T> values(OIIO::TypeDesc type) const {
    std::vector<T> all(spec().image_pixels() * static_cast<std::size_t>(spec().nchannels));
    REQUIRE(input_->read_image(0, 0, 0, spec().nchannels, type, all.data()));
    return all;
  }

 private:
  std::string bytes_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace dmpc::tests
