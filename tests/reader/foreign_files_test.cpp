// Files that are out to do harm: they are errors that say what is wrong, and soon.

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "apps/image_file.h"
#include "apps/mesh_file.h"
#include "apps/nff_reader.h"
#include "apps/reader/picture_reader.h"
#include "apps/reader/process.h"
#include "apps/text_input.h"
#include "core/expect.h"
#include "tests/support/hostile_files.h"

namespace dmpc::tests {

namespace {

namespace fs = std::filesystem;
using apps::read_mesh_file;

std::string complaint_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

std::string mesh_complaint(const std::string& path, const apps::MeshOptions& options = {}) {
  return complaint_of([&] { read_mesh_file(path, options, false, {.seconds = 1, .wall_factor = 30}); });
}

bool says(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) {
    MESSAGE(text);
  }
  return found;
}

/// A port of this computer that somebody listens at.
class Ear {
 public:
  Ear() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    REQUIRE(::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), size) == 0);
    REQUIRE(::listen(socket_.number(), 4) == 0);
    ::getsockname(socket_.number(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = std::to_string(ntohs(address.sin_port));
  }
  std::string address() const { return "http://127.0.0.1:" + port_ + "/t.mp4"; }
  bool has_been_called() const { return ::accept(socket_.number(), nullptr, nullptr) >= 0; }

 private:
  apps::Descriptor socket_;
  std::string port_;
};

void write_wood(const fs::path& path) { apps::write_image(path, apps::Image(2, 2)); }

}  // namespace

TEST_CASE("no scene makes dmpc call the network") {
  const TemporaryFolder folder;
  const Ear ear;
  write_text(folder / "a.gltf", gltf_triangle("\"uri\":\"" + ear.address() + "\""));
  const std::string gltf = mesh_complaint(folder / "a.gltf"),
                    obj = mesh_complaint(write_textured_triangle(folder, ear.address()));
  CHECK(says(gltf, "is an address, and only files are read"));
  CHECK(says(obj, "t.mp4"));
  CHECK_FALSE(ear.has_been_called());
}

TEST_CASE("devices and pipes are no textures and no materials") {
  const TemporaryFolder folder;
  const std::string device = mesh_complaint(write_textured_triangle(folder, "/dev/zero"), {.opens_anywhere = true});
  CHECK(says(device, "a pipe, a device or the like"));
  REQUIRE(::mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
  CHECK(says(mesh_complaint(write_textured_triangle(folder, "pipe.png")), "pipe.png"));
  write_textured_triangle(folder, "a.png");
  fs::remove(folder / "a.mtl");
  REQUIRE(::mkfifo((folder / "a.mtl").c_str(), 0600) == 0);
  CHECK(says(mesh_complaint(folder / "a.obj"), "a.mtl is a pipe"));
  REQUIRE(::mkfifo((folder / "a.ply").c_str(), 0600) == 0);
  CHECK(says(mesh_complaint(folder / "a.ply"), "is a pipe"));
}

TEST_CASE("what lies neither beside nor below the scene is opened only where that is allowed") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "scene/below");
  write_wood(folder / "above.png");
  write_wood(folder / "scene/below/wood.png");
  fs::create_symlink("../above.png", folder / "scene/link.png");
  write_textured_triangle(folder, "");
  fs::rename(folder / "a.obj", folder / "scene/a.obj");
  const std::string scene = folder / "scene/a.obj";
  for (const std::string name : {"../above.png", "link.png"}) {
    CAPTURE(name);
    write_text(folder / "scene/a.mtl", "newmtl m\nmap_Kd " + name + "\n");
    CHECK(says(mesh_complaint(scene), "by --files=anywhere"));
    CHECK(read_mesh_file(scene, {.opens_anywhere = true}).scene.textures.size() == 1);
    CHECK(read_mesh_file(scene, {.allows_missing = true}).scene.textures.empty());
  }
  write_text(folder / "scene/a.mtl", "newmtl m\nmap_Kd below/wood.png\n");
  const apps::MeshFile file = read_mesh_file(scene);
  CHECK(file.scene.textures.size() == 1);
  CHECK(file.opened.paths().contains(fs::canonical(folder / "scene/below/wood.png")));
}

TEST_CASE("a reader that never ends is ended, and its file named") {
  const TemporaryFolder folder;
  write_text(folder / "t.ply", "ply\nformat ascii 1.0\nelement vertex 3\nprop");
  const std::string text = mesh_complaint(folder / "t.ply");
  CHECK(says(text, "t.ply: "));
}

TEST_CASE("a reader's crash is an error of the file, which is named") {
  const TemporaryFolder folder;
  write_textured_triangle(folder, "");
  write_text(folder / "a.mtl", "Ns 10\nmap_Kd -s 1 1 1 -o 0 0 a\nd 0.5\nillum 2\n");  // of no material
  const std::string text = mesh_complaint(folder / "a.obj");
  CHECK(says(text, "a.obj: "));
#if defined(__SANITIZE_ADDRESS__)  // which makes an exit of a crash
  CHECK(says(text, "the reader of OBJ files ended with status 1"));
#else
  CHECK(says(text, "the reader of OBJ files crashed (signal 11"));
#endif
  CHECK(says(text, "a.mtl"));
}

TEST_CASE("a file is read as what its ending says, and by no reader of other files") {
  const TemporaryFolder folder;
  for (const std::string beginning : {"IDPO", "IDP2", "MDL7", "MDL5"}) {
    CAPTURE(beginning);
    write_text(folder / "a.gltf", beginning + std::string(400, '\1'));
    CHECK(says(mesh_complaint(folder / "a.gltf"), "a.gltf: "));
    CHECK(mesh_complaint(folder / "a.gltf").find("crashed") == std::string::npos);
  }
}

TEST_CASE("pictures of other kinds are refused, whatever they are called") {
  const TemporaryFolder folder;
  write_text(folder / "t.png", "FOR4" + std::string(100, '\2') + "CIMG");
  CHECK(says(mesh_complaint(write_textured_triangle(folder, "t.png")), "expected PNG, JPEG"));
}

TEST_CASE("a picture that says to be larger than its file can hold is refused") {
  const TemporaryFolder folder;
  write_text(folder / "t.exr", exr_header(40000, 30000));
  const std::string text = complaint_of([&] { apps::read_image(folder / "t.exr"); });
  CHECK(says(text, "t.exr: "));
  CHECK(says(text, "it is damaged"));
}

TEST_CASE("a device is no scene, and neither is a pipe that nobody writes to") {
  const TemporaryFolder folder;
  for (const std::string device : {"/dev/zero", "/dev/urandom", "/dev/null"}) {
    CHECK(says(complaint_of([&] { apps::read_nff_file(device); }), device + ": is a device or the like"));
  }
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(says(complaint_of([&] { apps::read_nff_file(folder / "pipe"); }), "nobody writes to"));
}

TEST_CASE("a line that does not end, and endless comments, are refused") {
  const TemporaryFolder folder;
  write_text(folder / "zeros", "");
  fs::resize_file(folder / "zeros", std::uint64_t{1} << 40U);
  CHECK(says(complaint_of([&] { apps::read_nff_file(folder / "zeros"); }), "zeros:1: found a line of more than 16 MiB"));
  std::string comments;
  const std::string line = "#" + std::string(1U << 20U, '.') + "\n";
  for (int i = 0; i < 65; ++i) {
    comments += line;
  }
  write_text(folder / "comments", comments);
  CHECK(says(complaint_of([&] { apps::read_nff_file(folder / "comments"); }), "nothing but blanks and comments"));
}

TEST_CASE("a scene may come through a pipe, however slowly") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const pid_t writer = ::fork();
  if (writer == 0) {
    const int end = ::open(pipe.c_str(), O_WRONLY);
    for (const std::string part : {"v from 0 0 5 at 0 0 0 up 0 1 0 an", "gle 45 hither 1 resolution 8 8\n"}) {
      static_cast<void>(::write(end, part.data(), part.size()));
      ::usleep(20'000);
    }
    ::_exit(0);
  }
  CHECK(apps::read_nff_file(pipe).view.width == 8);
}

}  // namespace dmpc::tests
