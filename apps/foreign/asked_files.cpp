#include "apps/foreign/asked_files.h"

#include <algorithm>
#include <utility>

#include "apps/foreign/mapped_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

Packer& add_edges(Packer& fields, const TextureEdges& edges) {
  return fields.add(edges.s).add(edges.t).add(edges.alpha).add(edges.cutoff).add(edges.coat);
}

std::string_view as_text(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

Message AskedFiles::ask(Saying question, const Packer& fields) {
  std::optional<Message> message;
  if (!line_.send(question, fields) || !(message = line_.receive(true))) {
    throw HungUp();
  }
  return std::move(*message);
}

std::unique_ptr<FileBytes> AskedFiles::open(const std::string& path) {
  const Message message = ask(Saying::open, Packer().add_text(path));
  Unpacker fields(message.bytes);
  if (message.saying != Saying::file) {
    throw core::InputError(fields.take_text());
  }
  return map_file(message.file, fields.take<std::uint64_t>());
}

bool AskedFiles::exists(const std::string& path) { return ask(Saying::exists, Packer().add_text(path)).saying == Saying::yes; }

std::vector<std::filesystem::path> AskedFiles::meant(const std::filesystem::path& folder, const std::string& name) {
  const Message message = ask(Saying::meant, Packer().add_text(folder.string()).add_text(name));
  std::vector<std::filesystem::path> paths;
  for (Unpacker fields(message.bytes); !fields.is_empty();) {
    paths.emplace_back(fields.take_text());
  }
  return paths;
}

void AskedFiles::ask_for_texture(Saying question, const Packer& fields) {
  const Message message = ask(question, fields);
  if (message.saying != Saying::yes) {
    throw core::InputError(Unpacker(message.bytes).take_text());
  }
}

void AskedFiles::send_bytes(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), message_bytes_max);
    if (!line_.send(Saying::bytes, as_text(bytes.first(count)))) {
      throw HungUp();
    }
    bytes = bytes.subspan(count);
  }
}

void AskedFiles::add_texture(const std::string& path, const TextureEdges& edges) {
  Packer fields;
  fields.add_text(path);
  ask_for_texture(Saying::texture_file, add_edges(fields, edges));
}

void AskedFiles::add_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                             const TextureEdges& edges) {
  send_bytes(file);
  Packer fields;
  fields.add_text(name).add_text(format_hint);
  ask_for_texture(Saying::texture_bytes, add_edges(fields, edges));
}

void AskedFiles::add_texture(std::span<const std::uint32_t> texels, std::uint32_t width, std::uint32_t height,
                             const std::string& name, const TextureEdges& edges) {
  send_bytes(std::as_bytes(texels));
  Packer fields;
  fields.add_text(name).add(width).add(height);
  ask_for_texture(Saying::texture_texels, add_edges(fields, edges));
}

/// A tenth of a percent more is worth a word.
void AskedFiles::show_progress(float share) {
  if (!(share > shown_ && share < shown_ + 0.001F)) {
    shown_ = share;
    line_.send(Saying::progress, Packer().add(share));
  }
}

}  // namespace dmpc::apps
