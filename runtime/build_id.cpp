// Reads the notes of loaded files (build_id.h).
#include "runtime/build_id.h"

#include <llvm-c/blake3.h>

#include <cstdint>
#include <elf.h>
#include <link.h>

namespace moonshade {

namespace {

struct Search {
  uintptr_t address;
  std::string id;
};

size_t padded(size_t size) { return (size + 3) & ~size_t{3}; }

/// The description of the note "GNU" of this type in a segment of notes.
std::string find_note(const char* at, size_t size) {
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    __builtin_memcpy(&note, at, sizeof note);
    const size_t name = sizeof note, description = name + padded(note.n_namesz);
    const size_t end = description + padded(note.n_descsz);
    if (end > size) break;
    if (note.n_type == NT_GNU_BUILD_ID && std::string(at + name, note.n_namesz) == std::string("GNU", 4)) {
      std::string digits;
      for (size_t i = 0; i < note.n_descsz; ++i) {
        const auto byte = static_cast<unsigned char>(at[description + i]);
        digits += "0123456789abcdef"[byte >> 4];
        digits += "0123456789abcdef"[byte & 15];
      }
      return digits;
    }
    at += end;
    size -= end;
  }
  return "";
}

int visit(dl_phdr_info* file, size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  bool holds = false;
  for (int i = 0; i < file->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = file->dlpi_phdr[i];
    const uintptr_t begin = file->dlpi_addr + segment.p_vaddr;
    holds = holds || (segment.p_type == PT_LOAD && search.address >= begin && search.address < begin + segment.p_memsz);
  }
  if (!holds) return 0;
  for (int i = 0; i < file->dlpi_phnum && search.id.empty(); ++i)
    if (const ElfW(Phdr)& segment = file->dlpi_phdr[i]; segment.p_type == PT_NOTE)
      search.id = find_note(reinterpret_cast<const char*>(file->dlpi_addr + segment.p_vaddr), segment.p_memsz);
  return 1;
}

std::string build_id_of(uintptr_t address) {
  Search search{address, {}};
  dl_iterate_phdr(visit, &search);
  return search.id;
}

} // namespace

const std::string& library_build_id() {
  static const std::string id = build_id_of(reinterpret_cast<uintptr_t>(&build_id_of));
  return id;
}

const std::string& llvm_build_id() {
  // By a text of its own: the address of a function may be a stub in the program.
  static const std::string id = build_id_of(reinterpret_cast<uintptr_t>(llvm_blake3_version()));
  return id;
}

} // namespace moonshade
