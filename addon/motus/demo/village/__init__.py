"""The winter village, which the scenes of snow and of all systems share: ground, houses, trees and falling snow."""
