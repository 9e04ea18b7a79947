-- What others change and read while files run.
runs = 1
return { scale = 1, count = { 0 } }
