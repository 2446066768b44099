#include "apps/foreign/asked_files.h"

#include <algorithm>
#include <utility>

#include "apps/foreign/mapped_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
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

void AskedFiles::ask_for_texture(Saying question, const Packer& fields, const TextureEdges& edges) {
  const Message message =
      ask(question, Packer(fields).add(edges.s).add(edges.t).add(edges.alpha).add(edges.cutoff).add(edges.coat));
  if (message.saying != Saying::yes) {
    throw core::InputError(Unpacker(message.bytes).take_text());
  }
}

void AskedFiles::send(std::span<const std::byte> bytes) {
  if (!send_bytes(bytes, line_)) {
    throw HungUp();
  }
}

void AskedFiles::add_texture(const std::string& path, const TextureEdges& edges) {
  ask_for_texture(Saying::texture_file, Packer().add_flag(weighs_).add_text(path), edges);
}

void AskedFiles::add_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                             const TextureEdges& edges) {
  constexpr std::size_t head_bytes = std::size_t{1} << 20U;
  send(file.first(std::min(file.size(), weighs_ ? head_bytes : file.size())));
  ask_for_texture(Saying::texture_bytes, Packer().add_flag(weighs_).add_text(name).add_text(format_hint), edges);
}

/// A tenth of a percent more is worth a word.
void AskedFiles::show_progress(float share) {
  if (!(share > shown_ && share < shown_ + 0.001F)) {
    shown_ = share;
    line_.send(Saying::progress, Packer().add(share));
  }
}

}  // namespace dmpc::apps
