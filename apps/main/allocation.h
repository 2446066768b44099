// How the program has its memory.
#pragma once

namespace dmpc::apps {

/// To be called before anything is allocated in earnest. What is freed is kept for the next who asks: glibc by itself gives
/// blocks from 128 KiB on back to the system at once, and where a page's first touch is dear (some 20 us on a virtual machine)
/// building a database spent more time on getting them again than on anything else. With allocation.cpp goes an operator new that
/// asks for large pages for large blocks. Under the address sanitizer, which has an allocator of its own, neither does anything.
void keep_freed_memory();

}  // namespace dmpc::apps
