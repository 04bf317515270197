// A file that changes as a whole or not at all, however large it is and whenever the process is killed.
//
// While a change is prepared, bytes beyond the old end are written to the file at once and all others stay in
// memory: whoever opens the file sees the old content and, behind its end, bytes that do not concern him.
// commit() then
//   1. flushes what lies beyond the old end,
//   2. writes the few changed pages of the old part to a journal beside the file (whole: aside, flushed,
//   renamed),
//   3. writes them to the file, flushes, removes the journal.
// A kill before the journal is in place leaves the old content, any later one a journal that the next open
// replays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "coupling/io/posix_file.h"

namespace interstice::io {

class GuardedFile {
 public:
  enum class Mode { read, change, create };

  /// Opens and recovers, or creates (the name must be free). A reader that may not write sees the recovered
  /// content without changing the file. Throws std::system_error, or InputError where the journal beside the
  /// file is another file's.
  GuardedFile(const std::filesystem::path& path, Mode mode);
  /// Without a commit() the file is as it was.
  ~GuardedFile();
  GuardedFile(const GuardedFile&) = delete;
  GuardedFile& operator=(const GuardedFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Beyond the end: zeros.
  void read(std::uint64_t offset, void* data, std::size_t bytes) const;
  /// Never fails at once: HDF5 crashes at the end of the process when the writes of a closing file failed.
  /// Instead the reason is kept for commit() and failure(), and what follows goes to memory if it is
  /// `read_again`, else nowhere.
  void write(std::uint64_t offset, const void* data, std::size_t bytes, bool read_again = true) noexcept;
  void set_size(std::uint64_t size) { size_ = size; }
  /// Before the first write: the content ends at `size`; what follows was left by a killed writer.
  void forget_beyond(std::uint64_t size);

  int failure() const { return failure_; }  ///< errno of the failed write, or 0
  void commit();
  /// True as soon as the change will survive, even if commit() threw after that.
  bool committed() const { return committed_; }
  /// Lets writers go on while this reader keeps the file open.
  void unlock();

  static std::filesystem::path journal_of(const std::filesystem::path& path);

 private:
  enum class Lock { shared, exclusive };
  using Pages = std::map<std::uint64_t, std::vector<char>>;  // by offset

  /// The recovering reader: changes the disk only if it gets the lock at once.
  struct Recovery {};
  GuardedFile(const std::filesystem::path& path, Recovery);

  static const std::filesystem::path& recovered(const std::filesystem::path& path);
  bool try_lock(Lock kind);
  void wait_for_lock(Lock kind);
  bool load_journal();  // false: there is none, or only the beginning of one
  void write_journal() const;
  void take_back_journal() noexcept;
  void apply();
  void write_through(std::uint64_t offset, const void* data, std::size_t bytes);
  void continue_in_memory(int reason);
  std::vector<char>& page_at(std::uint64_t offset);
  std::uint32_t fingerprint() const;

  std::filesystem::path path_;
  Mode mode_;
  PosixFile file_;
  std::uint64_t size_ = 0;       // of the content as seen through this object
  std::uint64_t old_size_ = 0;   // up to here the file itself stays as it is until commit()
  std::uint64_t in_memory_ = 0;  // up to here writes go to pages_: old_size_, or all after a failure
  Pages pages_;                  // changed pages of the old part
  int failure_ = 0;
  bool committed_ = false;
};

}  // namespace interstice::io
