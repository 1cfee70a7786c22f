#include "dalembert/sweep/journal.h"

#include <dalembert/core/errors.h>

#include <boost/crc.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace dalembert {

namespace {

/// The last digit is the version of the layout; numbers are those of the machine, so that one of another byte
/// order is no journal.
constexpr char magic[] = "dalembert sweep journal 1\n";
constexpr std::uint64_t mark = 0x6b636f6c62776f72;

/// Before the bytes of each block, and of the header, which is a block of no rows.
struct Head {
  std::uint64_t mark = dalembert::mark;
  std::uint64_t checksum = 0;  ///< of what follows it here, and of the bytes
  std::uint64_t bytes = 0, first = 0, count = 0, failures = 0, samples = 0;
};

std::uint64_t checksum(const Head& head, std::string_view bytes) {
  boost::crc_32_type sum;
  sum.process_bytes(&head.bytes, sizeof head - offsetof(Head, bytes));
  sum.process_bytes(bytes.data(), bytes.size());
  return sum.checksum();
}

std::string framed(Head head, std::string_view bytes) {
  head.bytes = bytes.size();
  head.checksum = checksum(head, bytes);
  std::string frame(reinterpret_cast<const char*>(&head), sizeof head);
  return frame.append(bytes);
}

std::uint64_t size_of(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace

Journal::Journal(std::string path, const Header& header, std::uint64_t rows) : path_(std::move(path)) {
  open_locked();
  try {
    recover(header, rows);
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

void Journal::fail(const std::string& what, int error) const {
  throw Error(path_ + ": " + what + ": " + std::generic_category().message(error));
}

/// Whoever finished the sweep in between has removed the file that was opened: then once more.
void Journal::open_locked() {
  for (;;) {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) fail("cannot be opened; does its folder exist?", errno);
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      close(std::exchange(file_, -1));
      if (error == EWOULDBLOCK)
        throw Error(path_ + ": another process is at this sweep; wait for it or end it");
      fail("cannot be locked", error);
    }
    struct stat status {};
    if (fstat(file_, &status) == 0 && status.st_nlink > 0) return;
    close(std::exchange(file_, -1));
  }
}

void Journal::begin(const Header& header) {
  if (ftruncate(file_, 0) != 0) fail("cannot be written", errno);
  end_ = 0;
  write(magic + framed({}, packed(header)));
  sync();
}

/// Reads all blocks up to the first that is not whole, and cuts off the rest.
void Journal::recover(const Header& header, std::uint64_t rows) {
  const std::uint64_t size = size_of(file_), start = sizeof magic - 1;
  const std::string begins = read(0, std::min(size, start));
  if (!std::string_view(magic).starts_with(begins))
    throw Error(path_ + " is no journal of a sweep; give the sweep another file");
  std::uint64_t at = start;
  bool first = true;
  while (at + sizeof(Head) <= size) {
    Head head;
    std::memcpy(&head, read(at, sizeof head).data(), sizeof head);
    if (head.mark != mark || head.bytes > size - at - sizeof head) break;
    const std::string bytes = read(at + sizeof head, head.bytes);
    if (checksum(head, bytes) != head.checksum) break;
    if (first) {
      require_same(path_, unpacked(bytes), header);
    } else {
      if (head.first > rows || head.count > rows - head.first) break;
      entries_.push_back(
          {{head.first, head.count}, head.failures, head.samples, at + sizeof head, head.bytes});
    }
    first = false;
    at += sizeof head + head.bytes;
  }
  if (first) {
    if (size > start + framed({}, packed(header)).size())
      throw Error(path_ + ": its header is damaged; restore the file, or remove it to begin anew");
    return begin(header);  // killed before there was a row
  }
  if (ftruncate(file_, static_cast<off_t>(at)) != 0) fail("cannot be written", errno);
  end_ = at;
}

void Journal::write(const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const auto count =
        pwrite(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(end_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int error = count < 0 ? errno : ENOSPC;
      [[maybe_unused]] const int cut = ftruncate(file_, static_cast<off_t>(end_));
      fail("cannot be written; all rows before are safe, the same command goes on from there", error);
    }
    done += static_cast<std::size_t>(count);
  }
  end_ += bytes.size();
}

void Journal::append(const Block& block) {
  write(framed({.first = block.rows.first,
                .count = block.rows.count,
                .failures = block.failures,
                .samples = block.samples},
               block.bytes));
  entries_.push_back(
      {block.rows, block.failures, block.samples, end_ - block.bytes.size(), block.bytes.size()});
}

std::string Journal::read(const Entry& entry) const { return read(entry.offset, entry.bytes); }

std::string Journal::read(std::uint64_t offset, std::uint64_t count) const {
  std::string bytes(count, '\0');
  for (std::size_t done = 0; done < count;) {
    const auto got = pread(file_, bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("cannot be read", got < 0 ? errno : EIO);
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

void Journal::sync() const {
  if (fdatasync(file_) != 0 && errno != EINVAL) fail("cannot be written", errno);
}

void Journal::remove() { unlink(path_.c_str()); }

}  // namespace dalembert
