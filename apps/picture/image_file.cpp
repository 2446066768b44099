#include "apps/picture/image_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "apps/picture/exr_file.h"
#include "apps/picture/picture_reader.h"
#include "apps/picture/png_file.h"
#include "apps/reader/process.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps {
namespace fs = std::filesystem;

namespace {

/// A picture of three channels, floats or bytes, row by row from the top left, to be written to a file.
struct PictureValues {
  int width = 0, height = 0;
  bool are_floats = false;  ///< linear light, else bytes on the sRGB curve
  std::span<const std::byte> values;
};

/// Its input is ours, so it gets as much time as the largest picture takes on a busy computer, and no sandbox.
constexpr ReaderLimits limits{.seconds = 1'000'000, .sandbox = Sandbox::none};

std::string received_file(ReaderProcess& process) {
  std::string file;
  for (;;) {
    const Message message = process.receive();
    switch (message.saying) {
      case Saying::bytes:
        file += message.bytes;
        break;
      case Saying::done:
        return file;
      case Saying::bad_input:
        throw core::InputError("cannot be written: " + Unpacker(message.bytes).take_text());
      default:
        throw Nonsense("its writer says nonsense");
    }
  }
}

/// The process dmpc_picture_writer starts at the first call and stays alive until the end, so that a finished picture has a
/// writer; a dead one is replaced. Both functions throw core::InternalError or InstallationError if there is none, and
/// core::CapacityError if this computer has not enough memory for it. Not thread-safe.
class PictureWriter {
 public:
  PictureWriter() : budget_(limits) {}

  /// Returns whether there is a writer for files with this extension (".tif").
  bool writes(const std::string& extension) {
    return ask([&](ReaderProcess& process) {
      process.send(Saying::writes, Packer().add_text(extension));
      return process.receive().saying == Saying::yes;
    });
  }

  /// Returns the file that would be written under this name. Throws core::InputError, a sentence that continues "PATH: ...", if
  /// there is none.
  std::string file_of(const std::string& name, const PictureValues& picture) {
    return ask([&](ReaderProcess& process) {
      const Packer fields =
          Packer().add_text(name).add(picture.width).add(picture.height).add(static_cast<std::uint8_t>(picture.are_floats));
      process.send(Saying::write_picture, fields);
      process.send_bytes(picture.values);
      return received_file(process);
    });
  }

 private:
  template <class Ask>
  std::invoke_result_t<Ask, ReaderProcess&> ask(const Ask& ask_process) {
    for (bool is_new = !process_.has_value();; is_new = true) {
      try {
        if (is_new) {
          process_.reset();
          process_.emplace("dmpc_picture_writer", 0, budget_);
        }
        return ask_process(*process_);
      } catch (const ReaderDeath& death) {
        if (is_new) {
          process_.reset();
          throw core::InputError(std::string("cannot be written: dmpc_picture_writer ") + death.what());
        }
      }
    }
  }

  ReadingBudget budget_;
  std::optional<ReaderProcess> process_;
};

/// Returns the one of this process.
PictureWriter& picture_writer() {
  static PictureWriter writer;
  return writer;
}

std::string lower_extension(const fs::path& path) { return in_small_letters(path.extension().string()); }

bool takes_floats(std::string_view extension) {
  return extension == ".exr" || extension == ".tif" || extension == ".tiff" || extension == ".hdr";
}

/// For all but these two extensions a process that is slow to start is asked.
void check_extension(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png" && (extension.empty() || !picture_writer().writes(extension))) {
    throw core::InputError(path.string() + ": cannot write pictures " +
                           (extension.empty() ? "without an extension" : "of the kind " + extension) +
                           ", use .exr or .tif (linear floats), .png or .jpg (8 bits, sRGB)");
  }
}

std::vector<std::uint8_t> srgb_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(), core::srgb_byte);
  return bytes;
}

/// Of each pixel the picture's three numbers, then those of its layers.
void take_with_layers(const ImageRows& image, std::size_t channels, std::size_t first, std::span<float> numbers) {
  std::vector<float> rgb(numbers.size() / channels * 3);
  image.take(first, rgb);
  auto to = numbers.begin();
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    to = std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(i), 3, to);
    for (const Channels* const layer : image.layers) {
      const std::size_t count = layer->names.size();
      to = std::copy_n(layer->values.begin() + static_cast<std::ptrdiff_t>((first + i / 3) * count), count, to);
    }
  }
}

std::string exr_of(const ImageRows& image) {
  ExrRows rows{image.width, image.height, {"R", "G", "B"}, image.take, image.remarks};
  for (const Channels* const layer : image.layers) {
    for (const std::string& name : layer->names) {
      rows.channels.push_back(layer->layer + "." + name);
    }
  }
  if (!image.layers.empty()) {
    rows.take = [&image, count = rows.channels.size()](std::size_t first, std::span<float> numbers) {
      take_with_layers(image, count, first, numbers);
    };
  }
  return exr_file(rows);
}

constexpr std::size_t pixels_at_once = 256;

void take_srgb(const ImageRows& image, std::size_t first, std::span<std::uint8_t> rgb) {
  std::array<float, 3 * pixels_at_once> room;
  for (std::size_t done = 0; done < rgb.size();) {
    const std::span some = std::span(room).first(std::min(room.size(), rgb.size() - done));
    image.take(first + done / 3, some);
    std::transform(some.begin(), some.end(), rgb.begin() + static_cast<std::ptrdiff_t>(done), core::srgb_byte);
    done += some.size();
  }
}

std::string png_of(const ImageRows& image) {
  return png_file(
      {image.width, image.height, [&image](std::size_t first, std::span<std::uint8_t> rgb) { take_srgb(image, first, rgb); }});
}

/// The image outlives the rows.
ImageRows rows_of(const Image& image) {
  core::expect(image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
               "an image has three floats for each pixel");
  const std::span<const float> rgb(image.rgb);
  const auto take = [rgb](std::size_t first, std::span<float> some) {
    const std::span<const float> from = rgb.subspan(3 * first, some.size());
    std::copy(from.begin(), from.end(), some.begin());
  };
  return {image.width, image.height, take, image.remarks};
}

std::string file_of(const fs::path& path, const Image& image) {
  const bool are_floats = takes_floats(lower_extension(path));
  const std::vector<std::uint8_t> bytes = are_floats ? std::vector<std::uint8_t>() : srgb_bytes(image);
  const PictureValues picture{.width = image.width,
                              .height = image.height,
                              .are_floats = are_floats,
                              .values = are_floats ? std::as_bytes(std::span(image.rgb)) : std::as_bytes(std::span(bytes))};
  try {
    return picture_writer().file_of(path.string(), picture);
  } catch (const ComputerCapacityError&) {
    throw;
  } catch (const core::CapacityError&) {
    throw ComputerCapacityError(path.string() + ": there is no memory to write it");
  } catch (const core::InputError& error) {
    throw core::InputError(path.string() + ": " + error.what());
  }
}

}  // namespace

Image image_of(const ImageRows& rows) {
  Image image(rows.width, rows.height);
  rows.take(0, image.rgb);
  image.remarks = rows.remarks;
  return image;
}

void check_image_path(const fs::path& path, std::string_view option) {
  check_extension(path);
  check_output_path(path, option);
  if (is_special(path)) {
    throw core::InputError(
        std::string(option) + " " + path.string() +
        ": this is no ordinary file, and a picture is not written from front to back; give the name of a file");
  }
  static_cast<void>(encoded_picture(path, Image(1, 1)));
}

std::string encoded_picture(const fs::path& path, const Image& image) {
  const std::string extension = lower_extension(path);
  if (extension == ".exr" || extension == ".png") {
    return encoded_picture(path, rows_of(image));
  }
  core::expect(image.width > 0 && image.height > 0, "a picture to be written has at least one pixel");
  check_extension(path);
  return file_of(path, image);
}

std::string encoded_picture(const fs::path& path, const ImageRows& image) {
  core::expect(image.width > 0 && image.height > 0, "a picture to be written has at least one pixel");
  const std::string extension = lower_extension(path);
  if (extension == ".exr") {
    return exr_of(image);
  }
  return extension == ".png" ? png_of(image) : encoded_picture(path, image_of(image));
}

std::string encoded_picture(const fs::path& path, const Channels& channels) {
  core::expect(lower_extension(path) == ".exr", "numbers are kept in EXR files");
  const std::size_t count = channels.names.size();
  core::expect(
      channels.values.size() == count * static_cast<std::size_t>(channels.width) * static_cast<std::size_t>(channels.height),
      "channels have numbers for each pixel");
  const auto take = [count, values = std::span<const float>(channels.values)](std::size_t first, std::span<float> some) {
    std::ranges::copy(values.subspan(first * count, some.size()), some.begin());
  };
  return exr_file({channels.width, channels.height, channels.names, take, channels.remarks});
}

void write_image(const fs::path& path, const Image& image) { write_file(path, encoded_picture(path, image)); }

Image read_image(const fs::path& path, Sandbox sandbox) {
  return PictureReader({.sandbox = sandbox}).read_image(open_picture(path));
}

}  // namespace dmpc::apps
