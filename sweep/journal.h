#pragma once

#include <dalembert/sweep/block.h>
#include <dalembert/sweep/header.h>

#include <cstdint>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The truth of an unfinished sweep: a file that only grows, by blocks of rows with a checksum each.
///
/// Whatever moment a process is killed at, the file is what was written before it, and at most one torn block
/// at the end, which the next to open it cuts off. (After a loss of power the same holds up to the last
/// `sync`.) A block that cannot be written, on a full disk, is cut off likewise. Between processes the file
/// is locked while it is open.
class Journal {
 public:
  /// Where a block is.
  struct Entry {
    Interval rows;
    std::uint64_t failures, samples, offset, bytes;
  };

  /// Opens or makes it. Throws Error if it is another sweep's or no journal, another process has it open, or
  /// it cannot be read or written.
  Journal(std::string path, const Header& header, std::uint64_t rows);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// Throws Error if it cannot be written; the file is then as before.
  void append(const Block& block);
  /// The bytes of a block. May be called while another thread appends.
  [[nodiscard]] std::string read(const Entry& entry) const;
  /// Onto the disk. May be called while another thread appends.
  void sync() const;
  /// Deletes the file; nothing else may follow.
  void remove();

 private:
  void open_locked();
  void begin(const Header& header);
  void recover(const Header& header, std::uint64_t rows);
  void write(const std::string& bytes);
  [[nodiscard]] std::string read(std::uint64_t offset, std::uint64_t count) const;
  [[noreturn]] void fail(const std::string& what, int error) const;

  std::string path_;
  int file_ = -1;
  std::uint64_t end_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace dalembert
