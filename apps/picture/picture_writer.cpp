#include "apps/picture/picture_writer.h"

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What it gets is ours: as much time as the largest picture takes on a busy computer, and no sandbox.
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

}  // namespace

PictureWriter::PictureWriter() : budget_(limits) {}

template <class Ask>
auto PictureWriter::ask(const Ask& ask_process) {
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

bool PictureWriter::writes(const std::string& extension) {
  return ask([&](ReaderProcess& process) {
    process.send(Saying::writes, Packer().add_text(extension));
    return process.receive().saying == Saying::yes;
  });
}

std::string PictureWriter::file_of(const std::string& name, const PictureValues& picture) {
  return ask([&](ReaderProcess& process) {
    const Packer fields =
        Packer().add_text(name).add(picture.width).add(picture.height).add(static_cast<std::uint8_t>(picture.are_floats));
    process.send(Saying::write_picture, fields);
    process.send_bytes(picture.values);
    return received_file(process);
  });
}

PictureWriter& picture_writer() {
  static PictureWriter writer;
  return writer;
}

}  // namespace dmpc::apps
