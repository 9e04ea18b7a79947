function height(p)
  return _ENV.x + _G.y
end
-- error: 2:10 environment-table
-- error: 2:19 environment-table
