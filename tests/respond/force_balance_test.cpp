// Forces of a free decay and of a shaken mass against one another.
#include "respond/force_balance.hpp"

#include <gtest/gtest.h>

#include "respond/decay.hpp"

namespace hysteron {
namespace {

using testing::Decay;

Rig rig_of(double mass) {
  Rig rig;
  rig.mass = mass;
  rig.stiffness = Decay::stiffness;
  return rig;
}

TEST(ForceBalance, TellsADampersOwnForceFromOneOnTheMass) {
  Recording recording = Decay{}.recording();
  const Rig rig = rig_of(Decay::mass);
  EXPECT_FALSE(is_of_damper(recording, rig));
  for (const double speed : recording.velocity) recording.force.push_back(Decay::damping * speed);
  EXPECT_TRUE(is_of_damper(recording, rig));
  // A force that makes this motion of a mass on a damper of twice the size is one that acts on it.
  for (double& force : recording.force) force = -force;
  EXPECT_FALSE(is_of_damper(recording, rig));
}

TEST(ForceBalance, TellsAMassInGrams) {
  const Recording recording = Decay{}.recording();
  const auto right = inertia_over_known(recording, rig_of(Decay::mass));
  ASSERT_TRUE(right);
  EXPECT_NEAR(*right, 1.0, 0.2);
  const auto wrong = inertia_over_known(recording, rig_of(1000.0 * Decay::mass));
  ASSERT_TRUE(wrong);
  EXPECT_NEAR(*wrong, 1000.0 * *right, 1.0);
  // Nothing is known to act on it.
  EXPECT_FALSE(inertia_over_known(recording, Rig{}));
}

}  // namespace
}  // namespace hysteron
