light { type = "area", u = { math.mininteger, 0, 0 } }
light { type = "sky" }
