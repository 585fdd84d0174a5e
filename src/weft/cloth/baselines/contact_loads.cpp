#include "weft/cloth/baselines/contact_loads.h"

#include <algorithm>

namespace weft {

double ContactLoads::own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal) {
  const int n = inverse_diagonal.cols();
  double compliance = 0;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    if (contact.weights[i] == 0) continue;
    const double w = contact.weights[i];
    compliance += w * w * inverse_diagonal(contact.samples[i] / n, contact.samples[i] % n);
  }
  return compliance > 0 ? 1 / compliance : 0;
}

void ContactLoads::set_contacts(std::span<const Contact> contacts) {
  contacts_ = contacts;
  stiffness_.assign(contacts.size(), 0.0F);
  grip_.assign(contacts.size(), 0.0F);
  load_.assign(contacts.size(), Vec3f{});
  stiff_ = 0;
  gather_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t k = 0; k < contacts[i].samples.size(); ++k)
      if (contacts[i].weights[k] != 0)
        gather_.add(contacts[i].samples[k], static_cast<int>(i), contacts[i].weights[k]);
  gather_.finish();
}

void ContactLoads::count(Worker& worker) {
  worker.barrier();
  if (worker.rank() == 0)
    stiff_ = static_cast<int>(std::count_if(stiffness_.begin(), stiffness_.end(),
                                            [](float stiffness) { return stiffness > 0; }));
  gather_.mark_rows(stiffness_, worker);
  worker.barrier();
}

}  // namespace weft
