// The program dmpc_picture_writer: makes files of pictures for dmpc, which starts it.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/service.h"
#include "apps/frontend/system/memory_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::unique_ptr<OIIO::ImageOutput> create_output(const std::string& name) {
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) {
    static_cast<void>(OIIO::geterror());  // clears OpenImageIO's message
  }
  return output;
}

/// OpenImageIO's "null" and "term" write no file.
bool writes(const std::string& extension) {
  return extension != ".null" && extension != ".term" && create_output("picture" + extension) != nullptr;
}

OIIO::ImageSpec specification(int width, int height, bool are_floats) {
  OIIO::ImageSpec spec(width, height, 3, are_floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", are_floats ? "Linear" : "sRGB");
  spec.attribute("Software", "dmpc");
  if (are_floats) {
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("CompressionQuality", 95);
  }
  return spec;
}

std::string file_of(const std::string& name, const OIIO::ImageSpec& spec, const void* values) {
  const std::unique_ptr<OIIO::ImageOutput> output = create_output(name);
  if (!output) {
    throw core::InputError("there is no writer for it");
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput into_bytes(bytes);
  const MemoryFile file;
  const bool takes_bytes = output->supports("ioproxy") && output->set_ioproxy(&into_bytes);
  if (!output->open(takes_bytes ? name : file.path(), spec) || !output->write_image(spec.format, values) || !output->close()) {
    throw core::InputError(output->geterror());
  }
  return takes_bytes ? std::string(bytes.begin(), bytes.end()) : file.bytes();
}

/// The first writer of a kind that is made has the library look round for others, and load what lies where these variables say.
void prepare_writers() {
  ::unsetenv("OIIO_LIBRARY_PATH");
  ::unsetenv("LD_LIBRARY_PATH");
  OIIO::attribute("threads", 1);
  static_cast<void>(writes(".tif"));
}

void serve_picture(const Message& request, Line& line) {
  Unpacker fields(request.bytes);
  const std::string name = fields.take_text();
  if (request.saying == Saying::writes) {
    line.send(writes(name) ? Saying::yes : Saying::no);
    return;
  }
  const int width = fields.take<int>(), height = fields.take<int>();
  const OIIO::ImageSpec spec = specification(width, height, fields.take_flag());
  std::string values;
  while (values.size() < spec.image_bytes()) {
    const std::optional<Message> part = line.receive(false);
    if (!part || part->saying != Saying::bytes) {
      return;  // dmpc is no more
    }
    values += part->bytes;
  }
  const std::string file = file_of(name, spec, values.data());
  send_bytes(std::as_bytes(std::span(file)), line);
  line.send(Saying::done);
}

}  // namespace
}  // namespace dmpc::apps

int main() {
  dmpc::apps::prepare_writers();
  dmpc::apps::serve_requests(dmpc::apps::serve_picture, dmpc::apps::Matter::own);
}
