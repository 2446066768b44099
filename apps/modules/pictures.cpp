// The module dmpc_pictures.so: OpenImageIO writes pictures.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <vector>

#include "apps/edge/system/memory_file.h"
#include "apps/edge/system/module.h"
#include "apps/picture/picture_library.h"

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

OIIO::ImageSpec specification(const PictureValues& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels,
                       picture.are_floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", picture.are_floats ? "Linear" : "sRGB");
  spec.attribute("Software", "dmpc");
  if (picture.are_floats) {
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("CompressionQuality", 95);
  }
  return spec;
}

std::string file_of(const std::string& name, const PictureValues& picture, std::string& error) {
  const std::unique_ptr<OIIO::ImageOutput> output = create_output(name);
  if (!output) {
    error = "there is no writer for it";
    return {};
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput into_bytes(bytes);
  const MemoryFile file;
  const OIIO::ImageSpec spec = specification(picture);
  const bool takes_bytes = output->supports("ioproxy") && output->set_ioproxy(&into_bytes);
  const bool is_written =
      output->open(takes_bytes ? name : file.path(), spec) && output->write_image(spec.format, picture.values) && output->close();
  error = is_written ? std::string() : output->geterror();
  return is_written ? takes_bytes ? std::string(bytes.begin(), bytes.end()) : file.bytes() : std::string();
}

constexpr PictureLibrary library{writes, file_of};

}  // namespace
}  // namespace dmpc::apps

extern "C" __attribute__((visibility("default"))) const dmpc::apps::Module dmpc_module{DMPC_MODULES_BUILD, &dmpc::apps::library};
