"""From muscles to posture, and from posture to tissue."""
