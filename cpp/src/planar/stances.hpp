#pragma once

#include <map>
#include <string>
#include <vector>

#include "task_fields.hpp"

namespace mcplan::planar {

/// Walks through the phases of a file, each of which lists all its contacts or says what changes against the phase
/// before, and remembers where each contact was written. Contacts of a phase come in the order of the robot's
/// end-effectors, whatever their order in the file.
class Stances {
 public:
  /// `task`: its robot and its surfaces are known.
  Stances(const PlanarTask& task, model::Findings& found) : task_(task), found_(found) {}

  /// Contacts of the next phase; what is wrong with them is said, and then it has none.
  std::vector<PlanarContact> next(const model::PlanarPhaseKeys& keys);

  /// What is wrong with a contact that next() has returned, as the file calls it. What stood in the phase before
  /// already lies in what is new against that.
  InvalidPlanarTask located(const InvalidPlanarTask& found) const;

 private:
  struct Written {
    PlanarContact contact;
    std::string where;
    bool by_at;
  };

  bool change(const model::PlanarPhaseKeys& keys, const std::string& field);
  bool lift(int end_effector, const std::string& field);
  bool place(const std::vector<model::InFile<PlanarContact>>& contacts, const std::string& field, bool is_new);
  bool work_out(const model::InFile<PlanarContact>& entry, const std::string& field, PlanarContact& out);
  bool wrong(const std::string& field, const std::string& rule, const std::string& value = "");

  const PlanarTask& task_;
  model::Findings& found_;
  std::map<int, Written> current_;  ///< by end-effector
  bool is_known_ = true;            ///< what is in contact now
  std::vector<std::vector<Written>> phases_;
};

/// The keys that give exactly the contact.
model::PlanarContactKeys contact_keys(const PlanarContact& contact, const PlanarSurface& surface);

}  // namespace mcplan::planar
