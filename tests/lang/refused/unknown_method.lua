function height(p)
  return p:lenght()
end
-- error: 2:12 unknown-method
