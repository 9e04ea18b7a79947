sphre { radius = -1 }
