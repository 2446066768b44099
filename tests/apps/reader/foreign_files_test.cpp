// Files that are out to do harm: they are errors that say what is wrong, and soon.

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <string>

#include "apps/formats/mesh_file.h"
#include "apps/formats/nff_reader.h"
#include "apps/frontend/system/text_input.h"
#include "apps/picture/image_file.h"
#include "apps/picture/picture_reader.h"
#include "apps/reader/file_access.h"
#include "apps/reader/input_file.h"
#include "apps/reader/process.h"
#include "tests/support/complaint.h"
#include "tests/support/forked_process.h"
#include "tests/support/hostile_files.h"
#include "tests/support/text.h"

namespace dmpc::tests::foreign_files_test {

namespace {

namespace fs = std::filesystem;
using apps::read_mesh_file;

std::string mesh_complaint(const std::string& path, const apps::MeshOptions& options = {}, std::uint64_t seconds = 1) {
  return complaint_of([&] { read_mesh_file(path, options, false, {.seconds = seconds, .wall_factor = 30}); });
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

std::string picture_complaint(apps::PictureReader& reader, const fs::path& path) {
  return complaint_of([&] { reader.read_image(apps::open_picture(path)); });
}

std::string nff_complaint(const std::string& path) {
  return complaint_of([&] { apps::read_nff_file(path); });
}

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

TEST_CASE("of what lies elsewhere a scene is not even told that it is there") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "scene/below");
  for (const std::string name : {"above.png", "scene/below/wood.png", "scene/a.obj"}) {
    write_text(folder / name, "");
  }
  fs::create_symlink("../above.png", folder / "scene/link.png");
  const apps::FileAccess access(folder / "scene/a.obj", false), anywhere(folder / "scene/a.obj", true);
  CHECK(access.has(folder / "scene/below/wood.png"));
  CHECK(access.has(folder / "scene/a.obj"));
  for (const std::string name : {"above.png", "scene/../above.png", "scene/link.png"}) {
    CAPTURE(name);
    CHECK_FALSE(access.has(folder / name));
    CHECK(anywhere.has(folder / name));
  }
  CHECK_FALSE(anywhere.has(folder / "none.png"));
}

TEST_CASE("nothing lies below a folder whose name is too long to be told") {
  const TemporaryFolder folder;
  static std::string place;
  place = folder.path().string();
  CHECK(ForkedProcess([] {
          const std::string name(200, 'd');
          bool is_there = ::chdir(place.c_str()) == 0;
          for (int depth = 0; depth < 25; ++depth) {
            is_there = is_there && ::mkdir(name.c_str(), 0700) == 0 && ::chdir(name.c_str()) == 0;
          }
          write_text("a.obj", "v 0 0 0\n");
          try {
            return apps::FileAccess("a.obj", false).has(place) ? 1 : is_there ? 2 : 3;
          } catch (const core::InputError& error) {
            return std::string(error.what()).find("its name cannot be told") != std::string::npos ? 0 : 4;
          }
        }).status() == 0);
}

TEST_CASE("a reader gets so much time on the wall, and messages renew nothing") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "t.png");
  write_wood(folder / "t.png");
  const apps::ReaderLimits none{.wall_factor = 0};
  CHECK(says(complaint_of([&] { read_mesh_file(scene, {}, false, none); }), "the reader of OBJ files took more than 0 seconds"));
  apps::PictureReader pictures(none);
  CHECK(says(picture_complaint(pictures, folder / "t.png"), "t.png: the reader of png took more than 0 seconds"));
}

/// The process of this one that was started last; what the system says of its limit on processor time, in seconds.
int last_child() {
  const std::string id = std::to_string(::getpid());
  std::istringstream children(file_text("/proc/" + id + "/task/" + id + "/children"));
  int last = 0;
  while (children >> last) {
  }
  return last;
}

int processor_seconds_of(int process) {
  const std::string limits = file_text("/proc/" + std::to_string(process) + "/limits"), name = "Max cpu time";
  return std::stoi(limits.substr(limits.find(name) + name.size()));
}

TEST_CASE("a reader gets so much processor time, and all pictures together theirs") {
  const TemporaryFolder folder;
  write_wood(folder / "a.png");
  apps::PictureReader reader({.seconds = 7});
  reader.read_image(apps::open_picture(folder / "a.png"));
  const int process = last_child();
  const int first = processor_seconds_of(process);
  CHECK(first >= 8);  // 7 behind what it had taken to get ready, rounded up
  reader.read_image(apps::open_picture(folder / "a.png"));
  CHECK(last_child() == process);
  CHECK(processor_seconds_of(process) >= first);
  ::kill(process, SIGXCPU);
  CHECK(says(picture_complaint(reader, folder / "a.png"), "took more than 7 seconds of processor time"));
}

/// A DDS of plain pixels, with these masks of red, green, blue and alpha: OpenImageIO looks for the lowest bit of each.
std::string dds_with_masks(std::uint32_t flags, const std::array<std::uint32_t, 4>& masks) {
  std::string bytes = "DDS ";
  const auto add = [&bytes](std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>(word >> shift & 0xffU);
    }
  };
  for (const std::uint32_t word : {124U, 0x1007U, 4U, 4U, 16U}) {
    add(word);
  }
  for (int i = 0; i < 13; ++i) {
    add(0);
  }
  for (const std::uint32_t word : {32U, flags, 0U, 32U}) {
    add(word);
  }
  for (const std::uint32_t mask : masks) {
    add(mask);
  }
  for (const std::uint32_t word : {0x1000U, 0U, 0U, 0U, 0U}) {
    add(word);
  }
  return bytes + std::string(64, 'x');
}

TEST_CASE("a DDS whose pixels have no bits of a colour is refused before it is read for ever") {
  const TemporaryFolder folder;
  constexpr std::uint32_t colors = 0x40, alpha = 0x1;
  const auto complaint = [&](std::uint32_t flags, const std::array<std::uint32_t, 4>& masks) {
    write_text(folder / "a.dds", dds_with_masks(flags, masks));
    apps::PictureReader reader({.seconds = 2});
    return picture_complaint(reader, folder / "a.dds");
  };
  CHECK(complaint(colors, {0xff0000, 0xff00, 0xff, 0}) == "");
  CHECK(says(complaint(colors, {0xff0000, 0xff00, 0, 0}), "a.dds: cannot be read as a picture: its pixels have no bits of blue"));
  CHECK(says(complaint(colors, {0, 0xff00, 0xff, 0}), "no bits of red"));
  CHECK(says(complaint(colors | alpha, {0xff0000, 0xff00, 0xff, 0}), "no bits of alpha"));
}

TEST_CASE("where pictures have taken the time of all, further ones are not begun, and each is told") {
  const TemporaryFolder folder;
  write_wood(folder / "a.png");
  apps::PictureReader reader({.seconds = 0, .bytes_a_second = std::uint64_t{1} << 40U});
  CHECK(says(picture_complaint(reader, folder / "a.png"),
             "a.png: is not read: pictures before it have taken the 0 seconds of processor time"));
}

TEST_CASE("questions about files are on the scene's budget, however many there are") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "");
  std::string materials, faces;
  for (int i = 0; i < 60'000; ++i) {
    const std::string name = std::to_string(i);
    materials += "newmtl m" + name + "\nmap_Kd nowhere" + name + ".png\n";
    faces += "usemtl m" + name + "\nf 1/1 2/2 3/3\n";
  }
  write_text(folder / "a.mtl", materials);
  write_text(scene, file_text(scene) + faces);
  const apps::ReaderLimits limits{.seconds = 1, .bytes_a_second = std::uint64_t{1} << 40U, .wall_factor = 1000};
  CHECK(says(complaint_of([&] { read_mesh_file(scene, {}, false, limits); }),
             "the reader of OBJ files took more than 1 second of processor time"));
}

TEST_CASE("a file of materials that is named again at once is asked for once") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "t.png");
  write_wood(folder / "t.png");
  write_text(scene, repeated(20'000, "mtllib a.mtl\n") + file_text(scene));
  CHECK(mesh_complaint(scene, {}, 5) == "");  // instrumented, on a busy machine
}

/// Whether the process that was started last has that library.
bool last_child_has(const std::string& library) {
  return file_text("/proc/" + std::to_string(last_child()) + "/maps").find(library) != std::string::npos;
}

TEST_CASE(
    "PNG, JPEG and EXR are read without OpenImageIO, by one process, until a picture of another format comes, and then by that "
    "one's") {
  const TemporaryFolder folder;
  write_wood(folder / "a.png");
  for (const std::string name :
       {"a.exr", "a.jpg", "a.tga"}) {  // larger files, since a reader has memory for one that is so large
    apps::write_image(folder / name, apps::Image(30, 20));
  }
  apps::PictureReader reader;
  const auto reader_of = [&](const std::string& name) {
    reader.read_texture(apps::open_picture(folder / name), {});
    return last_child();
  };
  const int plain = reader_of("a.jpg");
  CHECK(last_child_has("libjpeg"));
  CHECK_FALSE(last_child_has("OpenImageIO"));
  CHECK(reader_of("a.exr") == plain);
  CHECK(reader_of("a.png") == plain);
  const int any = reader_of("a.tga");
  CHECK(any != plain);
  CHECK(last_child_has("OpenImageIO"));
  CHECK(reader_of("a.png") == any);
}

TEST_CASE("a PNG that libpng complains of is left to OpenImageIO, which says why it is not read") {
  const TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(40, 40));
  write_text(folder / "a.png", file_text(folder / "a.png").substr(0, 60));
  apps::PictureReader reader;
  const std::string text = complaint_of([&] { reader.read_texture(apps::open_picture(folder / "a.png"), {}); });
  CHECK_MESSAGE(says(text, "a.png: cannot be read"), text);
  CHECK(last_child_has("OpenImageIO"));
}

/// One pixel of 200 50 30 that is transparent.
const std::string clear_png(
    "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\001\000\000\000\001\010\006\000\000"
    "\000\037\025\304\211\000\000\000\015\111\104\101\124\170\234\143\070\141\044\307\000\000\003\367\001\031\231\027"
    "\027\017\000\000\000\000\111\105\116\104\256\102\140\202",
    70);

TEST_CASE("an image with alpha is multiplied by it, as OpenImageIO does") {
  const TemporaryFolder folder;
  write_text(folder / "a.png", clear_png);
  apps::PictureReader reader;
  CHECK(reader.read_texture(apps::open_picture(folder / "a.png"), {}).levels.front().texels.front() == 0x1e32c8);
  CHECK_FALSE(last_child_has("OpenImageIO"));
  CHECK(reader.read_image(apps::open_picture(folder / "a.png")).rgb == std::vector<float>{0, 0, 0});
  CHECK(last_child_has("OpenImageIO"));
}

TEST_CASE("pictures each of which is larger than the one before are read by one process") {
  const TemporaryFolder folder;
  apps::PictureReader reader;
  std::set<int> processes;
  for (const int width : {8, 64, 512}) {
    apps::write_image(folder / "a.png", apps::Image(width, width));
    reader.read_image(apps::open_picture(folder / "a.png"));
    processes.insert(last_child());
  }
  CHECK(processes.size() == 1);
}

TEST_CASE("a crash of the reader of pictures is an error of the picture, which is named with its format") {
  const TemporaryFolder folder;
  write_wood(folder / "a.png");
  apps::PictureReader reader;
  reader.read_image(apps::open_picture(folder / "a.png"));
  ::kill(last_child(), SIGSEGV);
  const std::string text = picture_complaint(reader, folder / "a.png");
  CHECK(says(text, "a.png: the reader of png "));
  CHECK(says(text, "the file is damaged"));
#if !defined(__SANITIZE_ADDRESS__)  // which makes an exit of a crash
  CHECK(says(text, "crashed (signal 11"));
#endif
  CHECK(reader.read_image(apps::open_picture(folder / "a.png")).width == 2);
}

#if !defined(__SANITIZE_ADDRESS__)  // under which nothing is confined
namespace {

/// Stands in for a kernel without these calls; with "seccomp" goes the older way to it. "end with the parent" is one of prctl's.
bool forget_call(const std::string& call) {
  const scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ALLOW);
  const scmp_arg_cmp mode{0, SCMP_CMP_EQ, PR_SET_SECCOMP, 0}, end{0, SCMP_CMP_EQ, PR_SET_PDEATHSIG, 0};
  if (call == "end with the parent") {
    return ::seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, &end) == 0 && ::seccomp_load(filter) == 0;
  }
  const bool is_made =
      ::seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), ::seccomp_syscall_resolve_name(call.c_str()), 0) == 0 &&
      (call != "seccomp" || ::seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EINVAL), SCMP_SYS(prctl), 1, &mode) == 0);
  return is_made && ::seccomp_load(filter) == 0;
}

struct Reading {
  int status = 0;
  std::string said;
};

/// What a process says that reads two pictures where the kernel has no such call, and what is asked for.
Reading reading_without(const std::string& call, apps::Sandbox sandbox) {
  const TemporaryFolder folder;
  static std::string picture, errors, forgotten;
  static apps::Sandbox asked;
  picture = folder / "a.png", errors = folder / "errors", forgotten = call, asked = sandbox;
  write_wood(picture);
  const ForkedProcess process([] {
    const bool is_made = forget_call(forgotten) && ::open(errors.c_str(), O_CREAT | O_WRONLY, 0600) == STDERR_FILENO;
    const std::string complaint = complaint_of([] {
      apps::read_image(picture, asked);
      apps::read_image(picture, asked);
    });
    std::cerr << complaint << std::flush;
    return !is_made ? 1 : complaint.empty() ? 0 : 2;
  });
  const int status = process.status();
  return {status, file_text(errors)};
}

}  // namespace

TEST_CASE("where a reader's calls cannot be filtered, or the kernel has no Landlock, that is said, once, and what is missing") {
  for (const auto& [call, missing] : {std::pair<std::string, std::string>("seccomp", "no filter of system calls (seccomp)"),
                                      {"landlock_create_ruleset", "files not forbidden (Landlock)"},
                                      {"end with the parent", "no end with dmpc's own (PR_SET_PDEATHSIG)"}}) {
    CAPTURE(call);
    const Reading reading = reading_without(call, apps::Sandbox::available);
    CHECK(reading.status == 0);
    const std::string sentence =
        "does not confine the processes that read foreign files as it should: " + missing + ": read none";
    CHECK(says(reading.said, sentence));
    CHECK(reading.said.find(sentence) == reading.said.rfind(sentence));
  }
}

TEST_CASE("a computer that makes no file in memory is told of as one, and not as a bug") {
  const Reading reading = reading_without("memfd_create", apps::Sandbox::available);
  CHECK(reading.status == 2);
  CHECK(says(reading.said, "this computer lets no file in memory be made (memfd_create)"));
}

TEST_CASE("where the whole sandbox is required, nothing is read behind half of one") {
  for (const char* const call : {"seccomp", "landlock_create_ruleset"}) {
    const Reading reading = reading_without(call, apps::Sandbox::required);
    CHECK(reading.status == 2);
    CHECK(says(reading.said, "nothing is read, as --sandbox=required asks"));
  }
}

TEST_CASE("a whole sandbox is there, is read in, and is told of all readers together") {
  const TemporaryFolder folder;
  write_wood(folder / "a.png");
  CHECK(complaint_of([&] { apps::read_image(folder / "a.png", apps::Sandbox::required); }).empty());
  REQUIRE(apps::confinement_of_readers());
  CHECK(apps::confinement_of_readers()->is_full());
}
#endif

TEST_CASE("textures have a budget of memory that is all of theirs, and the one that is too much is named") {
  const TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(100, 10));
  apps::PictureReader reader({.texture_bytes_max = 24'000});  // 1000 texels with all levels, twice
  CHECK(reader.read_texture(apps::open_picture(folder / "a.png"), {}).levels.front().width == 100);
  CHECK(reader.read_texture(apps::open_picture(folder / "a.png"), {}).levels.front().width == 100);
  CHECK_THROWS_WITH_AS(reader.read_texture(apps::open_picture(folder / "a.png"), {}),
                       doctest::Contains("a.png: with its 100x10 texels the scene's textures take"), core::CapacityError);
}

TEST_CASE("textures are weighed by what stands before their pixels, before the first of them is unpacked") {
  const TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(100, 10));
  const std::string whole = file_text(folder / "a.png");
  std::string faces, materials;
  for (const std::string name : {"a", "b", "c"}) {
    write_text(folder / (name + ".png"), whole.substr(0, whole.size() - 20));
    faces += "usemtl " + name + "\nf 1/1 2/1 3/1\n";
    materials += "newmtl " + name + "\nmap_Kd " + name + ".png\n";
  }
  write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n" + faces);
  write_text(folder / "a.mtl", materials);
  const auto complaint = [&](std::uint64_t bytes) {
    return complaint_of([&] { read_mesh_file(folder / "a.obj", {}, false, {.texture_bytes_max = bytes}); });
  };
  CHECK(says(complaint(24'000), "c.png: with its 100x10 texels the scene's textures take"));
  CHECK(says(complaint(32'000), "a.png: cannot be read"));
}

TEST_CASE("a texture without a name and one with an endless one are said") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "\nmap_kd");
  const apps::MeshFile file = read_mesh_file(scene);
  const auto is_said = [](const std::string& note) { return note.find("map_Kd names no file in line 3 and 1 others") < 400; };
  CHECK(std::count_if(file.notes.begin(), file.notes.end(), is_said) == 1);
  const std::string text = mesh_complaint(write_textured_triangle(folder, std::string(200'000, 'x')));
  CHECK(says(text, "a.mtl: line 3: the name of a texture has 200,000 bytes"));
  CHECK(text.size() < 1000);
}

TEST_CASE("a reader that never ends is ended, and its file named") {
  const TemporaryFolder folder;
  write_text(folder / "t.ply", "ply\nformat ascii 1.0\nelement vertex 3\nprop");
  const std::string text = mesh_complaint(folder / "t.ply");
  CHECK(says(text, "t.ply: "));
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

TEST_CASE("what is a hole in a file gives its reader no time") {
  const TemporaryFolder folder;
  const auto bytes_in = [&](const std::string& text, std::uint64_t length) {
    write_text(folder / "a.obj", text);
    fs::resize_file(folder / "a.obj", length);
    apps::InputFile file = apps::find_input_file(folder / "a.obj");
    apps::open_input_file(file);
    CHECK(file.bytes == length);
    const std::uint64_t there = apps::bytes_without_holes(file.descriptor, file.bytes);
    CHECK(::lseek(file.descriptor.number(), 0, SEEK_CUR) == 0);  // where its reader begins
    return there;
  };
  CHECK(bytes_in("v 0 0 0\n", 8) == 8);
  CHECK(bytes_in("", 1 << 30) == 0);
  CHECK(bytes_in(std::string(10'000, 'v'), 1 << 30) < 1'000'000);
  CHECK(bytes_in(std::string(10'000, 'v'), 1 << 30) >= 10'000);
}

TEST_CASE("a device is no scene, and neither is a pipe that nobody writes to") {
  const TemporaryFolder folder;
  for (const std::string device : {"/dev/zero", "/dev/urandom", "/dev/null"}) {
    CHECK(says(nff_complaint(device), device + ": is a device or the like"));
  }
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(says(nff_complaint(folder / "pipe"), folder / "pipe: is a pipe that nobody writes to"));
}

TEST_CASE("a line that does not end, and endless comments, are refused") {
  const TemporaryFolder folder;
  write_text(folder / "zeros", "");
  fs::resize_file(folder / "zeros", std::uint64_t{1} << 40U);
  CHECK(says(nff_complaint(folder / "zeros"), "zeros:1: found a line of more than 16 MiB"));
  write_text(folder / "comments", repeated(65, "#" + std::string(1U << 20U, '.') + "\n"));
  CHECK(says(nff_complaint(folder / "comments"), "nothing but blanks and comments"));
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

}  // namespace dmpc::tests::foreign_files_test
