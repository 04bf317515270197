// What a list of contacts remembers from step to step, whatever they are contacts of: states, springs, and
// where asked for forces and heat.
#pragma once

#include <vector>

#include "dem/contact_memory.h"
#include "dem/springs.h"

namespace interstice::dem {

/// What the kernels see of them. Springs: by group, number and lane, forces by group, axis and lane, in the
/// kernels' number type; null where not kept.
struct MemoryView {
  GroupBits* bits;
  void* sliding;
  void* rolling;
  void* forces;
  PairHeat* heat;
};

class ContactMemories {
 public:
  ContactMemories(const KeptMemories& kept, Precision precision)
      : kept_(kept), sliding_(precision), rolling_(precision), forces_(precision) {}

  /// Of so many places, whole groups: none of them is listed, nothing is remembered.
  void reset(std::size_t places);
  void list(std::size_t k) { bits_[k / kLanes].list(k % kLanes); }
  /// Takes over what contact `from` of a former list remembers.
  void inherit(std::size_t k, const ContactMemories& old, std::size_t from);
  /// Makes a contact touch, with these springs (those that are not kept are left out).
  void set_touching(std::size_t k, const TangentialSpring<double>& sliding,
                    const TangentialSpring<double>& rolling);
  /// For a step after which forces are asked for; else they are zero.
  void keep_forces(bool keep);

  std::size_t groups() const { return bits_.size(); }
  const GroupBits& group(std::size_t g) const { return bits_[g]; }
  bool is_listed(std::size_t k) const { return bits_[k / kLanes].is_listed(k % kLanes); }
  ContactState state(std::size_t k) const { return bits_[k / kLanes].state(k % kLanes); }
  Vec3d force(std::size_t k) const { return vector_at(forces_, k); }  // in the last step [N]
  /// Zero unless touching.
  TangentialSpring<double> sliding(std::size_t k) const { return spring_at(sliding_, k); }
  TangentialSpring<double> rolling(std::size_t k) const { return spring_at(rolling_, k); }
  /// Where heat is kept.
  const PairHeat& heat(std::size_t k) const { return heat_[k]; }
  const KeptMemories& kept() const { return kept_; }

  MemoryView view();
  /// Asks for what the groups [begin, end) keep from step to step.
  void ask(std::size_t begin, std::size_t end) const;
  std::size_t bytes() const;

 private:
  KeptMemories kept_;
  std::vector<GroupBits> bits_;
  Reals sliding_, rolling_, forces_;
  std::vector<PairHeat> heat_;
};

}  // namespace interstice::dem
