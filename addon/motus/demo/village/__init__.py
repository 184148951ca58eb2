"""The winter village of the scenes "Motus Snow" and "Motus Main": ground, houses, trees and falling snow."""
