#include "coupling/io/guarded_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <thread>

#include "base/error.h"
#include "coupling/io/atomic_file.h"

namespace interstice::io {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kPage = 4096;
constexpr std::array<char, 8> kMark{'I', 'N', 'T', 'R', 'S', 'T', 'J', '1'};

struct JournalHead {
  std::array<char, 8> mark;
  std::uint64_t old_size;
  std::uint64_t new_size;
  std::uint64_t pages;        // each: offset, length (8 bytes each), bytes
  std::uint32_t fingerprint;  // of the file once the journal is applied
  std::uint32_t checksum;     // of the head with this field 0, and of all pages
};
static_assert(sizeof(JournalHead) == 40);

std::uint32_t checksum(std::uint32_t crc, const void* data, std::size_t bytes) {
  const auto* from = static_cast<const unsigned char*>(data);
  while (bytes > 0) {
    const auto n = static_cast<uInt>(std::min<std::size_t>(bytes, std::size_t{1} << 30));
    crc = static_cast<std::uint32_t>(::crc32(crc, from, n));
    from += n;
    bytes -= n;
  }
  return crc;
}

/// Empty where there is no such file (any more).
std::string bytes_of(const fs::path& path) {
  try {
    const PosixFile file(path, O_RDONLY);
    std::string bytes(file.size(), '\0');
    bytes.resize(file.read(0, bytes.data(), bytes.size()));
    return bytes;
  } catch (const std::system_error& error) {
    if (error.code().value() != ENOENT) throw;
    return {};
  }
}

int open_flags(GuardedFile::Mode mode) {
  switch (mode) {
    case GuardedFile::Mode::read:
      return O_RDONLY;
    case GuardedFile::Mode::change:
      return O_RDWR;
    case GuardedFile::Mode::create:
      break;
  }
  return O_RDWR | O_CREAT | O_EXCL;
}

std::uint32_t journal_checksum(const std::string& journal) {
  JournalHead head{};
  std::memcpy(&head, journal.data(), sizeof head);
  head.checksum = 0;
  return checksum(checksum(0, &head, sizeof head), journal.data() + sizeof head,
                  journal.size() - sizeof head);
}

}  // namespace

fs::path GuardedFile::journal_of(const fs::path& path) { return path.string() + ".journal"; }

GuardedFile::GuardedFile(const fs::path& path, Mode mode)
    : path_(path), mode_(mode), file_(mode == Mode::read ? recovered(path) : path, open_flags(mode)) {
  if (mode == Mode::create) return;
  wait_for_lock(mode == Mode::read ? Lock::shared : Lock::exclusive);
  size_ = old_size_ = in_memory_ = file_.size();
  const bool recover = load_journal();
  if (mode == Mode::read) return;
  if (recover) {
    apply();
    pages_.clear();
    old_size_ = in_memory_ = size_;
  } else {
    remove_file(journal_of(path_));
  }
  unlock();  // until commit(): preparing a change disturbs no reader
}

GuardedFile::GuardedFile(const fs::path& path, Recovery)
    : path_(path), mode_(Mode::change), file_(path, O_RDWR) {
  size_ = old_size_ = file_.size();
  committed_ = true;  // nothing to take back in the destructor
  if (try_lock(Lock::exclusive) && load_journal()) apply();
}

const fs::path& GuardedFile::recovered(const fs::path& path) {
  try {
    if (fs::exists(journal_of(path))) GuardedFile(path, Recovery{});
  } catch (const std::system_error&) {
    // Not ours to write: the reader overlays the journal in memory instead.
  }
  return path;
}

GuardedFile::~GuardedFile() {
  if (mode_ == Mode::read || committed_) return;
  try {
    file_.truncate(old_size_);
  } catch (const std::system_error&) {
    // Bytes beyond the end of the content harm nobody; the next change writes over them.
  }
}

bool GuardedFile::try_lock(Lock kind) {
  struct flock region {};
  region.l_type = kind == Lock::shared ? F_RDLCK : F_WRLCK;
  region.l_whence = SEEK_SET;
  region.l_start =
      std::numeric_limits<off_t>::max() - 1;  // far from any byte that another program might lock
  region.l_len = 1;
  return ::fcntl(file_.descriptor(), F_OFD_SETLK, &region) == 0 || (errno != EAGAIN && errno != EACCES);
}

/// The lock is a courtesy between processes of this program. It is not waited for long: some file systems
/// have none, and a simulation must not hang because somebody looks at its trajectory. Without it a reader
/// may at worst fail to list the frames of a file that changes at that very moment.
void GuardedFile::wait_for_lock(Lock kind) {
  for (int tries = 0; !try_lock(kind) && tries < 500; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void GuardedFile::unlock() {
  struct flock region {};
  region.l_type = F_UNLCK;
  region.l_whence = SEEK_SET;
  region.l_start = std::numeric_limits<off_t>::max() - 1;
  region.l_len = 1;
  ::fcntl(file_.descriptor(), F_OFD_SETLK, &region);
}

void GuardedFile::forget_beyond(std::uint64_t size) {
  size_ = old_size_ = in_memory_ = std::min(size, old_size_);
}

void GuardedFile::read(std::uint64_t offset, void* data, std::size_t bytes) const {
  char* to = static_cast<char*>(data);
  const std::size_t found = file_.read(offset, to, bytes);
  std::memset(to + found, 0, bytes - found);
  auto page = pages_.lower_bound(offset < kPage ? 0 : offset - kPage + 1);
  for (; page != pages_.end() && page->first < offset + bytes; ++page) {
    const std::uint64_t begin = std::max(offset, page->first);
    const std::uint64_t end = std::min(offset + bytes, page->first + page->second.size());
    if (begin < end)
      std::memcpy(to + (begin - offset), page->second.data() + (begin - page->first), end - begin);
  }
}

std::vector<char>& GuardedFile::page_at(std::uint64_t offset) {
  const auto [entry, added] = pages_.try_emplace(offset);
  if (added) {
    std::vector<char> bytes(std::min(kPage, in_memory_ - offset));
    file_.read(offset, bytes.data(), bytes.size());
    entry->second = std::move(bytes);
  }
  return entry->second;
}

void GuardedFile::write(std::uint64_t offset, const void* data, std::size_t bytes, bool read_again) noexcept {
  try {
    if (failure_ == 0) {
      try {
        return write_through(offset, data, bytes);
      } catch (const std::system_error& error) {
        continue_in_memory(error.code().value());
      }
    }
    if (read_again) write_through(offset, data, bytes);
  } catch (...) {
    if (failure_ == 0) failure_ = ENOMEM;
  }
}

void GuardedFile::write_through(std::uint64_t offset, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0 && offset < in_memory_) {
    const std::uint64_t start = offset / kPage * kPage;
    std::vector<char>& page = page_at(start);
    const std::size_t n = std::min<std::size_t>(bytes, start + page.size() - offset);
    std::memcpy(page.data() + (offset - start), from, n);
    from += n;
    offset += n;
    bytes -= n;
    size_ = std::max(size_, offset);
  }
  if (bytes > 0) file_.write(offset, from, bytes);
  size_ = std::max(size_, offset + bytes);
}

void GuardedFile::continue_in_memory(int reason) {
  failure_ = reason;
  const std::uint64_t last = in_memory_ / kPage * kPage;  // the page that the old end cut short
  in_memory_ = std::numeric_limits<std::uint64_t>::max() / 2;
  if (const auto page = pages_.find(last); page != pages_.end()) {
    const std::vector<char> kept = std::move(page->second);
    pages_.erase(page);
    std::copy(kept.begin(), kept.end(), page_at(last).begin());
  }
}

/// Tells this file from another of the same name: its head and its tail as they are once the journal is
/// applied, which is the same however much of the journal has been.
std::uint32_t GuardedFile::fingerprint() const {
  std::vector<char> window(std::min<std::uint64_t>(size_, 65536));
  read(0, window.data(), window.size());
  const std::uint32_t head = checksum(0, window.data(), window.size());
  read(size_ - window.size(), window.data(), window.size());
  return checksum(head, window.data(), window.size());
}

void GuardedFile::write_journal() const {
  JournalHead head{kMark, old_size_, size_, pages_.size(), fingerprint(), 0};
  std::string journal(reinterpret_cast<const char*>(&head), sizeof head);
  for (const auto& [offset, page] : pages_) {
    const std::uint64_t length = page.size();
    journal.append(reinterpret_cast<const char*>(&offset), sizeof offset);
    journal.append(reinterpret_cast<const char*>(&length), sizeof length);
    journal.append(page.data(), page.size());
  }
  head.checksum = journal_checksum(journal);
  std::memcpy(journal.data(), &head, sizeof head);
  write_text_atomically(journal_of(path_), journal);
}

bool GuardedFile::load_journal() {
  const fs::path name = journal_of(path_);
  const std::string journal = bytes_of(name);
  JournalHead head{};
  if (journal.size() < sizeof head) return false;
  std::memcpy(&head, journal.data(), sizeof head);
  if (head.mark != kMark || head.checksum != journal_checksum(journal)) return false;
  std::size_t at = sizeof head;
  Pages pages;
  for (std::uint64_t i = 0; i < head.pages; ++i) {
    std::array<std::uint64_t, 2> where{};  // offset, length; the checksum vouches for them
    std::memcpy(where.data(), journal.data() + at, sizeof where);
    at += sizeof where;
    pages[where[0]].assign(journal.data() + at, journal.data() + at + where[1]);
    at += where[1];
  }
  pages_ = std::move(pages);
  size_ = head.new_size;
  const bool right_size = old_size_ == head.new_size || old_size_ == std::max(head.old_size, head.new_size);
  if (!right_size || fingerprint() != head.fingerprint)
    throw InputError(
        path_.string() + ": the journal " + name.string() +
        " beside it belongs to another version of this file; bring back the file it belongs to, or "
        "delete the journal to use this one");
  return true;
}

void GuardedFile::apply() {
  for (const auto& [offset, page] : pages_) {
    if (offset < size_)
      file_.write(offset, page.data(), std::min<std::uint64_t>(page.size(), size_ - offset));
  }
  file_.truncate(size_);
  file_.sync();
  remove_file(journal_of(path_));
  sync_folder(folder_of(path_));
}

void GuardedFile::commit() {
  if (failure_ != 0) throw std::system_error(failure_, std::generic_category());
  file_.truncate(std::max(size_, old_size_));
  file_.sync();
  if (mode_ == Mode::create) {
    committed_ = true;
    return;
  }
  wait_for_lock(Lock::exclusive);
  try {
    write_journal();
  } catch (...) {
    take_back_journal();
    throw;
  }
  committed_ = true;
  apply();
  unlock();
}

/// Its writing may have failed after it was in place, when only the flush of the folder was missing.
void GuardedFile::take_back_journal() noexcept {
  std::error_code failed;
  const fs::path journal = journal_of(path_);
  if (!fs::exists(journal, failed) && !failed) return;
  fs::remove(journal, failed);
  committed_ = static_cast<bool>(failed);  // if it stays, what it completes must stay, too
}

}  // namespace interstice::io
