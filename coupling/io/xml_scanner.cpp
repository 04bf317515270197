#include "coupling/io/xml_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

constexpr std::size_t longest_word = 4096;  // of a name or an attribute; beyond it, this is no file of VTK
constexpr std::size_t deepest = 64;

bool blank(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

XmlScanner::XmlScanner(const std::filesystem::path& path) : bytes_(path), buffer_(std::size_t{1} << 16) {}

std::string XmlScanner::where() const { return path().string() + ":" + std::to_string(line_); }

void XmlScanner::wrong(const std::string& what) const { throw InputError(where() + ": " + what); }

bool XmlScanner::fill() {
  begin_ = 0;
  end_ = bytes_.read(buffer_.data(), buffer_.size());
  return end_ > 0;
}

int XmlScanner::peek() {
  if (begin_ == end_ && !fill()) return -1;
  return static_cast<unsigned char>(buffer_[begin_]);
}

int XmlScanner::get() {
  const int c = peek();
  if (c >= 0) ++begin_;
  if (c == '\n') ++line_;
  return c;
}

std::size_t XmlScanner::read(char* to, std::size_t count) {
  const std::size_t held = std::min(count, end_ - begin_);
  std::memcpy(to, buffer_.data() + begin_, held);
  begin_ += held;
  return held + (held < count ? bytes_.read(to + held, count - held) : 0);
}

int XmlScanner::need() {
  const int c = get();
  if (c < 0) {
    wrong(fmt::format("{} within {}; a whole file is needed; write it again",
                      damage().empty() ? "the file ends early" : damage(),
                      open_.empty() ? "its first tags" : "element " + shown(open_.back())));
  }
  return c;
}

void XmlScanner::skip_blanks() {
  while (blank(peek())) get();
}

void XmlScanner::pass_until(const char* end) {
  const std::string_view wanted(end);
  std::string last;
  while (last != wanted) {
    last += static_cast<char>(need());
    if (last.size() > wanted.size()) last.erase(0, 1);
  }
}

std::string XmlScanner::word() {
  std::string text;
  while (peek() >= 0 && !blank(peek()) && std::strchr("=/><\"'", peek()) == nullptr) {
    text += static_cast<char>(get());
    if (text.size() > longest_word)
      wrong("a name of more than 4096 letters; this is no VTK file; check the file");
  }
  if (text.empty()) wrong("a name is due in a tag; the XML is damaged; write the file again");
  return text;
}

std::string XmlScanner::quoted() {
  const int mark = need();
  if (mark != '"' && mark != '\'')
    wrong("an attribute without quotes; the XML is damaged; write the file again");
  std::string text;
  for (int c = need(); c != mark; c = need()) {
    text += static_cast<char>(c);
    if (c == '<' || text.size() > longest_word) {
      wrong("an attribute does not end; its closing quote is missing; write the file again");
    }
  }
  static const std::vector<std::pair<std::string, std::string>> entities{
      {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}};
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    for (const auto& [entity, letter] : entities) {
      if (text.compare(at, entity.size(), entity) != 0) continue;
      text.replace(at, entity.size(), letter);
      break;
    }
  }
  return text;
}

XmlScanner::Tag XmlScanner::close_tag() {
  get();  // the slash
  name_ = word();
  attributes_.clear();
  skip_blanks();
  if (need() != '>' || open_.empty() || open_.back() != name_) {
    wrong(fmt::format("</{}> where {} is due; the XML is damaged; write the file again", shown(name_),
                      open_.empty() ? "no closing tag" : "</" + shown(open_.back()) + ">"));
  }
  open_.pop_back();
  return Tag::close;
}

XmlScanner::Tag XmlScanner::open_tag() {
  name_ = word();
  attributes_.clear();
  for (;;) {
    skip_blanks();
    if (peek() == '>' || peek() == '/') break;
    const std::string key = word();
    skip_blanks();
    if (need() != '=') wrong("an attribute without a value; the XML is damaged; write the file again");
    skip_blanks();
    if (!attributes_.emplace(key, quoted()).second) {
      wrong(
          fmt::format("attribute `{}` twice in a tag; the XML is damaged; write the file again", shown(key)));
    }
  }
  closes_itself_ = get() == '/';
  if (closes_itself_ && need() != '>') wrong("`/` in a tag; the XML is damaged; write the file again");
  open_.push_back(name_);
  if (open_.size() > deepest)
    wrong("more than 64 elements in one another; this is no VTK file; check the file");
  return Tag::open;
}

XmlScanner::Tag XmlScanner::next() {
  if (closes_itself_) {
    closes_itself_ = false;
    open_.pop_back();
    return Tag::close;
  }
  for (;;) {
    if (open_.empty()) {
      skip_blanks();
      if (peek() < 0 && damage().empty()) return Tag::none;
    }
    while (peek() >= 0 && peek() != '<') get();
    need();
    if (peek() == '?') {
      pass_until("?>");
    } else if (peek() == '!') {
      get();
      if (need() != '-' || need() != '-') {
        wrong("DOCTYPE or CDATA, which VTK does not write; tags and comments only; write the file again");
      }
      pass_until("-->");
    } else if (peek() == '/') {
      return close_tag();
    } else {
      return open_tag();
    }
  }
}

const std::string* XmlScanner::attribute(const std::string& name) const {
  const auto it = attributes_.find(name);
  return it == attributes_.end() ? nullptr : &it->second;
}

void XmlScanner::skip_element() {
  const std::size_t depth = open_.size();
  while (open_.size() >= depth) {
    if (next() == Tag::none) return;
  }
}

}  // namespace interstice::io
