#include "apps/picture/picture_reader.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "apps/picture/picture_format.h"
#include "apps/reader/input_file.h"
#include "core/base/expect.h"
#include "core/scene/sky_texels.h"

namespace dmpc::apps {
namespace {

/// Memory in addition to a picture's data: the libraries' own, and the file itself.
constexpr std::uint64_t spare_bytes = std::uint64_t{512} << 20U;

/// Limit of the memory that is allocated for announced data before they arrive.
constexpr std::uint64_t believed_bytes_max = std::uint64_t{16} << 20U;

/// Memory for the decoded values, the converted ones, and the libraries' own data.
std::uint64_t memory_bytes_for(std::uint64_t file_bytes) {
  return std::min(spare_bytes + 2 * decoded_bytes_max(file_bytes) + file_bytes, reader_memory_bytes_max());
}

std::string size_text(std::uint32_t width, std::uint32_t height) { return std::to_string(width) + "x" + std::to_string(height); }

std::string format_text(const PictureFile& file) {
  const auto format = picture_format(file.descriptor, file.ending);
  if (!format) {
    throw core::InputError("is no picture that is read, by what it begins with; expected " + known_picture_formats());
  }
  return *format;
}

[[noreturn]] void fail_to_copy(const std::string& name, int error) {
  const std::string what = name + ": no copy of it can be made in memory";
  throw_if_short(error, what);
  throw core::InputError(what + ": " + std::strerror(error));
}

}  // namespace

PictureFile open_picture(const std::filesystem::path& path) {
  try {
    InputFile file = find_input_file(path);
    open_input_file(file);
    std::string ending = path.extension().string();
    ending.erase(0, 1);
    return {std::move(file.descriptor), file.bytes, path.string(), ending, true};
  } catch (const ComputerCapacityError&) {
    throw;
  } catch (const core::InputError& error) {
    throw core::InputError(path.string() + ": " + error.what());
  }
}

PictureFile picture_of(std::span<const std::byte> bytes, const std::string& name, const std::string& ending) {
  PictureFile file{Descriptor(::memfd_create("picture", MFD_CLOEXEC)), bytes.size(), name, ending, true};
  if (!file.descriptor.is_open()) {
    fail_to_copy(name, errno);
  }
  while (!bytes.empty()) {
    const ssize_t count = ::write(file.descriptor.number(), bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) {
      fail_to_copy(name, errno);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return file;
}

core::Texture PictureReader::read_texture(const PictureFile& file, const TextureEdges& edges) {
  core::Texture texture{.name = file.name, .wrap_s = edges.s, .wrap_t = edges.t, .levels = {}};
  read(file, {Saying::read_texture, edges.alpha}, [&](const Head& head) {
    check_texture_size(file.name, head.width, head.height);
    take_room(head, texture_bytes_);
    texture.format = head.format;
    hidden_alphas_ += head.hides_alpha ? 1 : 0;
    const std::uint64_t count = std::uint64_t{head.width} * head.height;
    texture.levels.push_back(
        {head.width, head.height, receive_values<std::uint32_t>(count, count)});  // take_room() has checked the size
  });
  put_below_coat(texture, edges.coat);
  core::add_levels(texture);
  core::keep_coverage(texture, edges.cutoff);
  return texture;
}

void PictureReader::weigh_texture(const PictureFile& file) {
  read(file, {Saying::weigh_picture, TextureAlpha::ignored}, [&](const Head& head) { take_room(head, weighed_bytes_); });
}

Image PictureReader::read_image(const PictureFile& file) {
  return read_image(file, [](const Head&) {});
}

Image PictureReader::read_sky(const PictureFile& file) {
  const auto check = [this](const Head& head) { check_sky(head); };
  read(file, {Saying::weigh_picture, TextureAlpha::ignored}, check);
  return read_image(file, check);
}

template <class Check>
Image PictureReader::read_image(const PictureFile& file, const Check& check) {
  Image image;
  read(file, {Saying::read_image, TextureAlpha::ignored}, [&](const Head& head) {
    check(head);
    image.width = static_cast<int>(head.width);
    image.height = static_cast<int>(head.height);
    image.rgb = receive_values<float>(std::uint64_t{head.width} * head.height * 3, believed_bytes_max / sizeof(float));
  });
  return image;
}

/// A process that sent invalid data, or died, is dropped.
template <class Take>
void PictureReader::read(const PictureFile& file, const Request& request, const Take& take) {
  std::string format = "pictures";
  try {
    format = format_text(file);
    take(ask(file, format, request));
    Unpacker::require(receive().saying == Saying::done);
  } catch (const ReaderDeath& death) {
    process_.reset();
    throw core::InputError(file.name + ": the reader of " + format + " " + death.what() +
                           ": the file is damaged; write it anew, or as another format");
  } catch (const ComputerCapacityError& error) {
    process_.reset();
    throw ComputerCapacityError(file.name + ": " + error.what());
  } catch (const core::CapacityError& error) {
    process_.reset();
    const std::string text = file.name + ": the reader of " + format + " " + error.what();
    if (memory_bytes_for(file.bytes) < reader_memory_bytes_max()) {
      throw core::InputError(text + " for a file of " + std::to_string(file.bytes) + " bytes: it is damaged");
    }
    throw core::CapacityError(text + ": make the picture smaller");
  } catch (const Nonsense& nonsense) {
    process_.reset();
    throw core::InputError(file.name + ": " + nonsense.what() + ": the file is damaged; write it anew, or as another format");
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    throw core::InputError(text.starts_with(file.name) ? text : file.name + ": " + text);
  }
}

/// A picture that the first program leaves to the other one has already used some of the budget.
PictureReader::Head PictureReader::ask(const PictureFile& file, const std::string& format, const Request& request) {
  budget_.add_bytes(file.is_new ? bytes_without_holes(file.descriptor, file.bytes) : 0);
  check_time();
  const bool is_any_there = process_ && program_ == Program::any,
             may_be_plain = std::ranges::find(plain_formats, format) != plain_formats.end();
  Message answer = answer_of(may_be_plain && !is_any_there ? Program::plain : Program::any, file, format, request);
  if (program_ == Program::plain && answer.saying == Saying::left_to_another) {
    answer = answer_of(Program::any, file, format, request);
  }
  return head_of(answer, file);
}

Message PictureReader::answer_of(Program program, const PictureFile& file, const std::string& format, const Request& request) {
  start(program, file.bytes);
  const Packer fields =
      Packer().add_text(file.name).add_text(format).add(static_cast<std::uint64_t>(file.bytes)).add(request.alpha);
  process_->send(request.saying, fields, &file.descriptor);
  return receive();
}

/// A picture that may need more memory than those before it needs a new process; limits are powers of two, so this is rare.
void PictureReader::start(Program program, std::uint64_t file_bytes) {
  const std::uint64_t memory = std::min(std::bit_ceil(memory_bytes_for(file_bytes)), reader_memory_bytes_max());
  if (!process_ || program != program_ || memory > memory_bytes_) {
    process_.reset();
    program_ = program;
    process_.emplace(program == Program::plain ? "dmpc_plain_picture_reader" : "dmpc_picture_reader", memory, budget_);
    memory_bytes_ = memory;
  }
}

/// Without time left no first process is started.
void PictureReader::check_time() const {
  if (!process_ && budget_.left() <= ReadingBudget::Time{}) {
    throw core::InputError("is not read: pictures before it have taken the " + counted(budget_.seconds(), "second") +
                           " of processor time that there is for all together: mend or leave out those");
  }
}

/// Counts the space per texel with all levels, which add a third: once as read, and once for the records made from it.
void PictureReader::take_room(const Head& head, std::uint64_t& taken) const {
  const std::uint64_t most = memory_bytes_max();
  taken += 2 * (std::uint64_t{head.width} * head.height * sizeof(std::uint32_t) * 4 / 3);
  if (taken > most) {
    throw ComputerCapacityError("with its " + size_text(head.width, head.height) + " texels the scene's textures take " +
                                mebibytes_text(taken) + ", and there is room for " + mebibytes_text(most) +
                                ": make them smaller");
  }
}

std::uint64_t PictureReader::memory_bytes_max() const {
  return budget_.limits().texture_bytes_max == 0 ? reader_memory_bytes_max() : budget_.limits().texture_bytes_max;
}

/// A texel takes three floats, then four bytes, then up to three times that in tiles that are made and laid out as records.
void PictureReader::check_sky(const Head& head) const {
  constexpr std::uint64_t texel_bytes = 3 * sizeof(float) + 4 * sizeof(std::uint32_t);
  const std::string size = size_text(head.width, head.height);
  if (std::max(head.width, head.height) > core::SkyTexels::size_max) {
    throw core::InputError("a sky of " + size + " texels; there may be " + std::to_string(core::SkyTexels::size_max) +
                           " along a side: make it smaller");
  }
  const std::uint64_t bytes = std::uint64_t{head.width} * head.height * texel_bytes;
  if (bytes + texture_bytes_ > memory_bytes_max()) {
    throw ComputerCapacityError("a sky of " + size + " texels takes " + mebibytes_text(bytes) +
                                (texture_bytes_ == 0 ? "" : ", the scene's textures " + mebibytes_text(texture_bytes_)) +
                                ", and there is room for " + mebibytes_text(memory_bytes_max()) + ": make it smaller");
  }
}

Message PictureReader::receive() {
  Message message = process_->receive();
  if (message.saying == Saying::bad_input) {
    throw core::InputError(Unpacker(message.bytes).take_text());
  }
  return message;
}

PictureReader::Head PictureReader::head_of(const Message& message, const PictureFile& file) {
  Unpacker::require(message.saying == Saying::picture);
  Unpacker fields(message.bytes);
  Head head{};
  head.width = fields.take<std::uint32_t>();
  head.height = fields.take<std::uint32_t>();
  head.format = fields.take_choice(core::TexelFormat::srgb_alpha);
  head.hides_alpha = fields.take_flag();
  fields.finish();
  Unpacker::require(head.width >= 1 && head.height >= 1 && head.width <= picture_side_max && head.height <= picture_side_max &&
                    decoded_bytes(head.width, head.height, 1) <= decoded_bytes_max(file.bytes));
  return head;
}

/// Allocates no more than `believed` of the announced size until data arrive.
template <class T>
std::vector<T> PictureReader::receive_values(std::uint64_t count, std::uint64_t believed) {
  std::vector<T> values;
  values.reserve(std::min(count, believed));
  while (values.size() < count) {
    const Message message = receive();
    const std::size_t more = message.bytes.size() / sizeof(T), before = values.size();
    Unpacker::require(message.saying == Saying::bytes && more > 0 && message.bytes.size() % sizeof(T) == 0 &&
                      more <= count - before);
    values.resize(before + more);
    std::memcpy(values.data() + before, message.bytes.data(), message.bytes.size());
  }
  return values;
}

}  // namespace dmpc::apps
